// Writes server/world/scenes/vale.toml: `node deploy/scenes/vale.mjs > server/world/scenes/vale.toml`. The same numbers
// at every run. Metres; x to the east, z to the south; a bearing of 0 is east, and a quarter turn is south.

const kRadius = 50;
/** The path leads from the fire to the second ring. */
const kWay = { x: 0.857, z: 0.515 };
const kHollow = { x: 42 * kWay.x, z: 42 * kWay.z };
/** Bearing of the sun: trees keep away from there, or their shadows would cover the vale. */
const kSunBearing = Math.atan2(-0.87, -0.46);

let state = 20260611;
/** A number from `low` to `high` (mulberry32). */
function random(low = 0, high = 1) {
  state = (state + 0x6d2b79f5) | 0;
  let t = Math.imul(state ^ (state >>> 15), 1 | state);
  t = (t + Math.imul(t ^ (t >>> 7), 61 | t)) ^ t;
  return low + ((high - low) * ((t ^ (t >>> 14)) >>> 0)) / 2 ** 32;
}

const distance = (a, b) => Math.hypot(a.x - b.x, a.z - b.z);
const at = (bearing, metres, centre = { x: 0, z: 0 }) => ({
  x: centre.x + metres * Math.cos(bearing),
  z: centre.z + metres * Math.sin(bearing),
});
const fromSun = (place) => Math.abs(Math.atan2(Math.sin(bearingOf(place) - kSunBearing), Math.cos(bearingOf(place) - kSunBearing)));
const bearingOf = (place) => Math.atan2(place.z, place.x);
/** Metres beside the path; infinite where there is none. */
function fromPath(place) {
  const along = place.x * kWay.x + place.z * kWay.z;
  const winding = along > 2 ? 0.9 * Math.sin(0.23 * along) : 0;
  return along > 0 && along < 42 ? Math.abs(place.z * kWay.x - place.x * kWay.z - winding) : Infinity;
}

/** Discs where no other tree or stone may stand. */
const taken = [
  { x: 0, z: 0, room: 7 },
  { x: 4.6, z: 10.4, room: 2.5 },
  { ...kHollow, room: 9 },
];
const isFree = (place, room) => fromPath(place) > room + 0.4 && taken.every((disc) => distance(disc, place) > disc.room + room);

/** `count` places that `propose` finds, each with `room` of its own. */
function scatter(count, room, propose) {
  const places = [];
  for (let tries = 0; places.length < count && tries < 20_000; tries += 1) {
    const place = propose();
    if (!isFree(place, room)) continue;
    taken.push({ ...place, room });
    places.push(place);
  }
  return places;
}
const within = (centre, metres) => () => at(random(0, 2 * Math.PI), metres * Math.sqrt(random()), centre);

/** What the scene says of each light field, and its places. Tiles have no scales. */
const fields = [];
function kinds(plant, seeds, settings, scales) {
  return seeds.map((seed) => {
    const field = { plant, seed, settings, scales, places: [] };
    fields.push(field);
    return field;
  });
}
const kFine = 'size = 256\nsubdivision = 8\nlightings = 1';
const kSmaller = 'size = 128\nsubdivision = 8\nlightings = 1';
const oaks = [...kinds('oak', [1, 2, 3], kFine, [0.8, 1.2]), ...kinds('oak', [4, 5, 6], kSmaller, [0.8, 1.25])];
const birches = [...kinds('birch', [1, 2, 3], kFine, [0.8, 1.15]), ...kinds('birch', [4, 5, 6, 7], kSmaller, [0.8, 1.3])];
const spruces = [...kinds('spruce', [1, 2], kFine, [0.7, 1.25]), ...kinds('spruce', [3, 4, 5, 6], kSmaller, [0.7, 1.5])];
const pines = [...kinds('pine', [1, 2], kFine, [0.9, 1.2]), ...kinds('pine', [3, 4, 5], kSmaller, [0.9, 1.4])];
const woods = kinds('copse', [1, 2, 3, 4, 5, 6, 7], 'size = 256\nsubdivision = 6\nlightings = 1', [0.95, 1.25]);
const meadows = kinds('meadow', [1, 2, 3, 4], kFine, null);
const flowers = kinds('flowers', [1, 2, 3, 4], kFine, null);
const ferns = kinds('fern', [1, 2, 3], kFine, null);

/** Puts plants, in turn, at these places. */
function plant(plants, places) {
  places.forEach((place, i) => {
    const field = plants[i % plants.length];
    field.places.push([place.x, place.z, 0, field.scales ? random(...field.scales) : 1]);
  });
}
const anyOf = (plants) => plants[Math.floor(random(0, plants.length))];

// The avenue: birches on either side of the path.
const avenue = [];
for (let along = 13; along < 34; along += 4.1) {
  for (const side of [-1, 1]) {
    const metres = along + random(-0.7, 0.7);
    const beside = side * random(3.3, 4.3);
    avenue.push({ x: metres * kWay.x - beside * kWay.z, z: metres * kWay.z + beside * kWay.x, room: 1.6 });
  }
}
taken.push(...avenue);
plant(birches.slice(0, 3), avenue);

// Around the ring, a pasture of oaks in the west, a grove of birches in the south, pines in the north-east.
plant([oaks[0], spruces[0], birches[1], oaks[1], spruces[1], oaks[2], birches[2]],
  [[-9.5, 1.2], [-13.2, -4.8], [3.1, -6.6], [11.4, -4.4], [9.4, -13.6], [-4.2, 17.5], [-7.9, -8.6]].map(([x, z]) => {
    taken.push({ x, z, room: 2.5 });
    return { x, z };
  }));
const kPasture = { x: -33, z: 8 };
const kGrove = { x: -7, z: 37 };
const kPines = { x: 31, z: -24 };
plant(oaks, scatter(13, 3.2, within(kPasture, 18)));
plant(birches, scatter(28, 1.3, within(kGrove, 11.5)));
plant([pines[0], pines[1], pines[2], spruces[0], pines[3], pines[4]], scatter(24, 1.6, within(kPines, 13)));

// A belt of single trees before the forest; towards the sun there are few.
plant(
  [spruces[2], oaks[3], pines[2], birches[3], spruces[3], birches[4], oaks[4], spruces[4], pines[3], birches[5], spruces[5], oaks[5], pines[4], birches[6]],
  scatter(108, 2, () => {
    for (;;) {
      const place = at(random(0, 2 * Math.PI), random(44, 70));
      if (fromSun(place) > 0.75 || random() < 0.12) return place;
    }
  }),
);

// The forest: three rows, and one far away towards the sun.
function row(metres, step, first) {
  const turn = step / metres;
  for (let bearing = first; bearing < first + 2 * Math.PI - 0.6 * turn; bearing += turn) {
    const place = at(bearing + random(-0.15, 0.15) * turn, metres + random(-2.5, 2.5));
    const isSunward = fromSun(place) < 0.62;
    if (isSunward === metres > 120) plant([anyOf(woods)], [place]);
  }
}
row(77, 13.5, 0.1);
row(91, 15, 0.25);
row(128, 17, 0.2);
row(143, 19, 0.3);

// Tiles on one lattice of hexagons, in patches with irregular edges.
function patch(centre, metres, plants) {
  const [first, second] = [random(0, 6), random(0, 6)];
  for (let i = -20; i <= 20; i += 1) {
    for (let j = -20; j <= 20; j += 1) {
      const place = { x: 3 * i + 0.5, z: Math.sqrt(3) * (2 * j + (i & 1)) + 0.7 };
      const bearing = Math.atan2(place.z - centre.z, place.x - centre.x);
      const reach = metres * (0.85 + 0.2 * Math.sin(2 * bearing + first) + 0.15 * Math.sin(3 * bearing + second));
      if (distance(place, centre) > reach || fromPath(place) < 2.6 || tiles.has(`${i} ${j}`)) continue;
      if (distance(place, { x: 0, z: 0 }) < 7.4 || distance(place, kHollow) < 8.4 || stones.some((s) => distance(s, place) < 2.6)) continue;
      tiles.add(`${i} ${j}`);
      plant([anyOf(plants)], [place]);
    }
  }
}
const tiles = new Set();

// Stones: a row that comes down from the north-west, and rocks.
const stones = [];
const marchers = Array.from({ length: 11 }, (_, i) => ({ x: -9.5 - 1.9 * i - 0.06 * i * i + random(-0.3, 0.3), z: -14 - 3.1 * i + random(-0.3, 0.3), room: 1.2 }));
taken.push(...marchers);
const rocks = scatter(24, 1.2, within({ x: 0, z: 0 }, 56));
stones.push(...marchers, ...rocks);

patch({ x: 12, z: -1 }, 6.5, [...flowers, ferns[0], meadows[0]]);
patch({ x: -10, z: 3 }, 7, [flowers[0], flowers[1], meadows[0], meadows[1], ferns[1]]);
patch({ x: -4, z: -11 }, 6, [meadows[2], ferns[0], ferns[1], flowers[2]]);
patch({ x: 9, z: 12 }, 6, [flowers[2], flowers[3], meadows[1]]);
patch({ x: 21, z: 18 }, 8, [flowers[0], flowers[3], meadows[3]]);
patch({ x: 25, z: 6 }, 7, [meadows[2], flowers[1], meadows[3]]);
patch(kPasture, 12, [meadows[0], meadows[1], meadows[2], flowers[2]]);
patch(kGrove, 12, [ferns[0], ferns[1], ferns[2], flowers[1]]);
patch({ x: kHollow.x + 4, z: kHollow.z + 6 }, 11, [flowers[0], flowers[1], flowers[2], flowers[3], meadows[3]]);
patch(kPines, 9, [ferns[2], ferns[0], meadows[2]]);
patch({ x: -20, z: -9 }, 8, [meadows[3], meadows[0], flowers[3]]);
patch({ x: 3, z: 24 }, 6, [meadows[1], flowers[0], ferns[2]]);

const n = (value, digits = 1) => value.toFixed(digits);
const out = [];
const table = (...lines) => out.push('', '[[object]]', ...lines);
function stone(name, seed, place, yaw, [height, width, depth], shape = 'stone', y = 0) {
  table('type = "mesh"', `name = "${name}"`, `shape = "${shape}"`, `seed = ${seed}`,
    `position = [${n(place.x, 2)}, ${n(y, 2)}, ${n(place.z, 2)}]`, `yaw_degrees = ${n(yaw, 0)}`,
    `height = ${n(height, 2)}`, `width = ${n(width, 2)}`, `depth = ${n(depth, 2)}`);
}
/** Degrees by which a stone on a ring shows its broad side to the middle. */
const facing = (bearing) => ((90 - (bearing * 180) / Math.PI + 540) % 360) - 180;

out.push(`# The large world: a vale with two rings of stones, an avenue of birches between them, a grove of birches, a pasture of
# oaks, and a forest around all. Written by deploy/scenes/vale.mjs; change that.
name = "The vale"
spawn = [4.6, 0, 10.4]
spawn_yaw_degrees = 24
radius = ${kRadius}

[visitor]
type = "figure"

[[light]]
position = [0, 0.55, 0]
colour = [2.6, 1.05, 0.3]
flicker = 0.7

[[light]]
position = [${n(kHollow.x, 2)}, 0.5, ${n(kHollow.z, 2)}]
colour = [1.5, 0.6, 0.17]
flicker = 0.7

[[object]]
type = "sky"
name = "evening sky"

[[object]]
type = "ground"
name = "meadow"
hearth = 1.7
path = [${n(kHollow.x, 2)}, 0, ${n(kHollow.z, 2)}]`);
for (const [x, z, radius, height] of [[-30, -32, 24, 1.2], [2, 60, 22, 1.1], [54, -6, 22, 1.2], [-56, 26, 24, 1.3], [16, -46, 22, 1.1],
  [96, 10, 44, 1.5], [40, 92, 44, 1.5], [-62, 82, 44, 1.5], [-100, -14, 44, 1.5], [70, -70, 40, 1.5], [-66, -112, 50, 1.5]]) {
  out.push('', '[[hill]]', `position = [${x}, 0, ${z}]`, `radius = ${radius}`, `height = ${height}`);
}
table('type = "mesh"', 'name = "camp fire"', 'shape = "logs"', 'seed = 3');
table('type = "fluid"', 'name = "fire and smoke"', 'grid = 64', 'size = 12', 'radius = 0.32', 'rate = 2300', 'wind = [0.22, 0, -0.06]');
table('type = "mesh"', 'name = "embers"', 'shape = "logs"', 'seed = 5', `position = [${n(kHollow.x, 2)}, 0, ${n(kHollow.z, 2)}]`, 'scale = 0.7');
table('type = "fluid"', 'name = "the hollow\'s fire"', `position = [${n(kHollow.x, 2)}, 0, ${n(kHollow.z, 2)}]`, 'grid = 32', 'size = 5', 'radius = 0.2', 'rate = 900', 'wind = [0.22, 0, -0.06]');

// The ring around the fire is open where the path leaves it; the hollow's is of eight tall stones, open to the west.
for (let i = 0; i < 11; i += 1) {
  const bearing = bearingOf(kWay) + 0.48 + (i * (2 * Math.PI - 0.96)) / 10;
  stone(`ring stone ${i + 1}`, 2 + i, at(bearing, random(4.5, 4.9)), facing(bearing) + random(-6, 6), [random(1.5, 3.8), random(0.85, 1.35), random(0.48, 0.7)]);
}
for (let i = 0; i < 8; i += 1) {
  const bearing = bearingOf({ x: -kWay.x, z: -kWay.z }) + 0.55 + (i * (2 * Math.PI - 1.1)) / 7;
  stone(`hollow stone ${i + 1}`, 40 + i, at(bearing, random(5.4, 5.8), kHollow), facing(bearing) + random(-5, 5), [random(3.2, 4.6), random(1, 1.5), random(0.55, 0.75)]);
}
marchers.forEach((place, i) => stone(`marcher ${i + 1}`, 60 + i, place, random(-40, 70), [random(0.9, 1.6) + 0.13 * i, random(0.6, 1), random(0.4, 0.55)]));
for (let i = 0; i < 4; i += 1) {
  const places = rocks.filter((_, k) => k % 4 === i).map((place) => [place.x, place.z, random(-180, 180), random(0.5, 1.3)]);
  table('type = "mesh"', `name = "rocks ${'abcdef'[i]}"`, 'shape = "rocks"', `seed = ${31 + i}`, `height = ${n(0.5 + 0.09 * i, 2)}`, `places = ${rows(places)}`);
}

out.push('', '# Each table below is a light field of its own. They are baked under one sun, so none is turned: all have the same light.');
for (const field of fields) {
  const isTile = field.scales === null;
  table('type = "lightfield"', `name = "${field.plant} ${'abcdefg'[field.seed - 1]}"`, `plant = "${field.plant}"`, `seed = ${field.seed}`, field.settings,
    ...(isTile ? ['position = [0, 0.02, 0]'] : []), `places = ${rows(field.places)}`);
}
function rows(places) {
  return `[\n${places.map(([x, z, yaw, scale]) => `  [${n(x, 3)}, ${n(z, 3)}, ${n(yaw, 0)}, ${n(scale, 2)}],`).join('\n')}\n]`;
}
process.stdout.write(`${out.join('\n')}\n`);
