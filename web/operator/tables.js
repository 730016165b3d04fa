import { fixed, known, percent, share, whole } from '../figures.js';
import { kLinkStates, kOperator } from '../texts.js';
import { LiveTable, bar, text, work } from './live_table.js';

function typesTable(body) {
  const table = new LiveTable(body, [
    (cell, { name }) => {
      text(() => name || kOperator.noType)(cell);
      if (!name) cell.title = kOperator.aboutNoType;
    },
    text(({ acrossUser }) => fixed(acrossUser, 2)),
    text(({ backend }) => fixed(backend, 2)),
    text(({ frontend }) => fixed(frontend, 2)),
    text(({ alpha }) => share(alpha)),
    text(({ beta }) => share(beta)),
    text(({ acrossUserMb }) => fixed(acrossUserMb, 1)),
    text(({ perVisitorMb }) => fixed(perVisitorMb, 1)),
  ]);
  return (amortization) => {
    const types = [...(amortization?.types ?? [])].sort((a, b) => (a.name || '~').localeCompare(b.name || '~'));
    const all = amortization ? [{ ...amortization, key: 'all', name: kOperator.typesSum }] : [];
    table.show([...types.map((type) => ({ key: `type ${type.name}`, ...type })), ...all]);
  };
}

function stagesTable(body) {
  const table = new LiveTable(body, [
    text(({ name }) => name),
    work,
    text(({ runsPerSecond }) => fixed(runsPerSecond, 1)),
    text(({ cpuPerRun }) => fixed(cpuPerRun, 2)),
    bar(({ share }) => share, ({ share }) => percent(share)),
    (cell, { failures }) => {
      text(() => whole(failures))(cell);
      cell.classList.toggle('bad', failures > 0);
    },
  ]);
  const rows = ({ process, stages }) => stages.map((stage) => ({ key: `${process} ${stage.name}`, ...stage }));
  return (processes) => table.show(inGroups(processes, rows));
}

/** The rows of all processes, below their names if there are several. */
function inGroups(processes, rows) {
  return processes.flatMap((one) => {
    const heading = processes.length > 1 ? [{ key: one.process, group: one.process }] : [];
    return [...heading, ...rows(one)];
  });
}

/** The rows of one process's memory, with the memory without a holder. */
function memoryRows({ process, memory }) {
  const holders = memory?.holders ?? [];
  const rows = holders.map((entry) => ({ key: `${process} ${entry.name} ${entry.type} ${entry.work}`, ...entry }));
  if (typeof memory?.rest === 'number') {
    const name = holders.length > 0 ? kOperator.rest : kOperator.unlisted;
    rows.push({ key: `${process} rest`, name, type: '', mb: memory.rest, share: memory.rest / memory.resident });
  }
  return rows;
}

function memoryTable(body) {
  const table = new LiveTable(body, [
    text(({ name }) => name),
    text(({ type }) => type),
    (cell, entry) => (entry.work ? work(cell, entry) : text(() => '')(cell)),
    text(({ mb }) => fixed(mb, 1)),
    bar(({ share }) => Math.min(1, share), ({ share }) => percent(share)),
  ]);
  return (processes) => table.show(inGroups(processes, memoryRows));
}

const kilobytes = (bytes) => (known(bytes) === null ? null : bytes / 1000);

function nodesTable(body) {
  const table = new LiveTable(body, [
    text(({ name }) => name),
    (cell, { state, reason }) => {
      text(() => kLinkStates[state] ?? state)(cell);
      cell.title = reason;
      cell.classList.toggle('bad', !['here', 'welcomed', 'joined'].includes(state));
    },
    text(({ objects }) => whole(objects)),
    text(({ sent_bytes_per_s: rate }) => fixed(kilobytes(rate), 1)),
    text(({ received_bytes_per_s: rate }) => fixed(kilobytes(rate), 1)),
    text(({ round_trip_ms: time }) => fixed(time, 1)),
    text(({ memory }) => fixed(memory?.resident_mb, 1)),
  ]);
  return (nodes) => table.show(nodes.map((node) => ({ key: node.name, ...node })));
}

/** The page's tables: functions that show their argument. */
export function makeTables(root) {
  const body = (id) => root.querySelector(`#${id} tbody`);
  return {
    types: typesTable(body('types')),
    stages: stagesTable(body('stages')),
    memory: memoryTable(body('memory')),
    nodes: nodesTable(body('nodes')),
  };
}
