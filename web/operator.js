import { amortizationOf } from './amortization.js';
import { known } from './figures.js';
import { makeCharts } from './operator/charts.js';
import { CostBars } from './operator/cost_bars.js';
import { memoryWords, writeFigures } from './operator/figures_panel.js';
import { frameCost } from './operator/frame_cost.js';
import { History } from './operator/history.js';
import { write } from './operator/live_table.js';
import { linksOf } from './operator/links.js';
import { Poll } from './operator/poll.js';
import { Processes } from './operator/processes.js';
import { situation } from './operator/situation.js';
import { makeTables } from './operator/tables.js';
import { kOperator, kOperatorPage } from './texts.js';
import { writeWords } from './words.js';

const element = (id) => document.getElementById(id);
writeWords(document, kOperatorPage);
writeWords(element('chart').content, kOperatorPage);
const processes = new Processes();
const history = new History();
const tables = makeTables(document);
const bars = new CostBars(element('frame'));
const drawCharts = makeCharts(element('charts').querySelector('div'), element('chart'));
let answeredAt = null;

const poll = new Poll({
  ask: () => fetch('/statistics.json', { cache: 'no-store' }).then(read),
  on: { answer, lost: () => leaveLive('lost') },
  timers: {
    setTimeout: (callback, delay) => window.setTimeout(callback, delay),
    clearTimeout: (timer) => window.clearTimeout(timer),
  },
});

async function read(reply) {
  const statistics = reply.ok ? await reply.json() : null;
  if (typeof statistics !== 'object' || statistics === null) throw new Error('the answer has no statistics');
  return statistics;
}

function answer(statistics) {
  const now = performance.now();
  const amortization = amortizationOf(statistics);
  answeredAt = new Date().toLocaleTimeString();
  processes.add(now, statistics);
  history.add(now, {
    visitors: known(statistics.visitors),
    cores: amortization?.cpuCores,
    alpha: amortization?.alpha,
    fps: amortization?.framesPerSecond,
  });
  show(statistics, amortization, now);
  enter('live', statistics);
}

/** Keeps the last figures, marked as old. */
function leaveLive(state) {
  processes.clear();
  enter(state);
}

function enter(state, statistics = null) {
  document.documentElement.dataset.state = state;
  write(element('state'), kOperator.states[state]);
  const words = situation(state, statistics, answeredAt);
  element('notice').classList.toggle('quiet', words === null);
  write(element('notice').querySelector('strong'), words?.title ?? '');
  write(element('notice').querySelector('span'), words?.text ?? '');
}

function show(statistics, amortization, now) {
  const memory = processes.memory();
  writeFigures(document, { statistics, amortization, cacheHits: processes.cacheHits() });
  bars.show(amortization && frameCost(amortization));
  drawCharts(history, now, amortization?.cores);
  tables.types(amortization);
  tables.stages(processes.stages());
  tables.memory(memory);
  const links = linksOf(statistics);
  tables.nodes(links);
  element('nodes').hidden = links.length === 0;
  write(element('resident'), memoryWords(memory[0].memory));
  element('types').hidden = amortization === null;
}

function watch() {
  if (document.hidden) {
    poll.stop();
    leaveLive('paused');
  } else {
    enter('asking');
    poll.start();
  }
}

document.addEventListener('visibilitychange', watch);
window.addEventListener('online', watch);
watch();
