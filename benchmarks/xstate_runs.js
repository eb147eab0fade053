// Runs machines in XState: a line of JSON in, {version, config, guards, assigns, raises, named, tick, steps};
// a line out, for each step the active states (by path), the context, and the named actions that ran.
// XSTATE is the folder of the packages: x5 (xstate@5) and x4 (xstate@4).
const path = require('path');
const of = (version) => require(path.join(process.env.XSTATE, version === 5 ? 'x5' : 'x4'));

const compiled = (text) => {
  const words = text.replace(/\b(x|b)\b/g, 'context.$1');
  return new Function('context', `return (${words});`);
};

function pathsOf(node, found = []) {
  found.push(node);
  Object.values(node.states).forEach((one) => pathsOf(one, found));
  return found;
}

function run5({ config, guards, free, assigns, raises, named, tick, steps }) {
  const x = of(5);
  let given = steps[0][1], ran = new Set();
  const implementations = { guards: {}, actions: {} };
  for (const [name, text] of Object.entries(guards)) {
    const made = compiled(text);
    implementations.guards[name] = ({ context }) => made(context);
  }
  for (const name of free) implementations.guards[name] = () => !!given[name];
  for (const [name, data] of Object.entries(assigns)) {
    const made = Object.fromEntries(Object.entries(data).map(([key, text]) => {
      const value = compiled(text);
      return [key, ({ context }) => value(context)];
    }));
    implementations.actions[name] = x.assign(made);
  }
  for (const [name, event] of Object.entries(raises)) implementations.actions[name] = x.raise({ type: event });
  for (const name of named) implementations.actions[name] = () => { ran.add(name); };
  const machine = x.createMachine({ ...config, options: { maxIterations: 60 } }, implementations);
  const clock = new x.SimulatedClock();
  const actor = x.createActor(machine, { clock });
  const told = [];
  actor.subscribe({ error: () => {} });
  const see = () => {
    const now = actor.getSnapshot();
    if (now.status === 'error') throw now.error;
    const active = now._nodes.filter((one) => one.type !== 'history').map((one) => one.path.join('.'));
    told.push([[...new Set(active)].sort(), { ...now.context }, [...ran].sort()]);
  };
  steps.forEach(([event, values], number) => {
    ran = new Set();
    given = values;
    const done = number && actor.getSnapshot().status === 'done';
    if (!number) actor.start();
    else if (!event && !done && tick) clock.increment(tick);
    if (event && actor.getSnapshot().status !== 'done') actor.send({ type: event });
    see();
  });
  return told;
}

function run4({ config, guards, free, assigns, raises, named, tick, steps }) {
  const x = of(4);
  let given = steps[0][1], ran = new Set();
  const implementations = { guards: {}, actions: {} };
  for (const [name, text] of Object.entries(guards)) {
    const made = compiled(text);
    implementations.guards[name] = (context) => made(context);
  }
  for (const name of free) implementations.guards[name] = () => !!given[name];
  for (const [name, data] of Object.entries(assigns)) {
    const made = Object.fromEntries(Object.entries(data).map(([key, text]) => {
      const value = compiled(text);
      return [key, (context) => value(context)];
    }));
    implementations.actions[name] = x.assign(made);
  }
  for (const [name, event] of Object.entries(raises)) implementations.actions[name] = x.actions.raise({ type: event });
  for (const name of named) implementations.actions[name] = () => { ran.add(name); };
  const machine = x.createMachine({ ...config, predictableActionArguments: true }, implementations);
  const { SimulatedClock } = require(path.join(process.env.XSTATE, 'x4', 'lib', 'SimulatedClock.js'));
  const clock = new SimulatedClock();
  const service = x.interpret(machine, { clock });
  const told = [];
  const see = () => {
    const now = service.getSnapshot();
    const active = now.configuration.filter((one) => one.type !== 'history').map((one) => one.path.join('.'));
    told.push([[...new Set(active)].sort(), { ...now.context }, [...ran].sort()]);
  };
  steps.forEach(([event, values], number) => {
    ran = new Set();
    given = values;
    const done = number && service.getSnapshot().done;
    if (!number) service.start();
    else if (!event && !done && tick) clock.increment(tick);
    if (event && !service.getSnapshot().done) service.send({ type: event });
    see();
  });
  return told;
}

console.warn = () => {};
console.error = () => {};
const log = console.log;
require('readline').createInterface({ input: process.stdin }).on('line', (line) => {
  const asked = JSON.parse(line);
  try {
    log(JSON.stringify({ told: (asked.version === 5 ? run5 : run4)(asked) }));
  } catch (error) {
    log(JSON.stringify({ error: String(error && error.message || error) }));
  }
});
