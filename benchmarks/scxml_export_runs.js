// Runs machines of SCXML in SCION 4.3.27: a line of JSON in, {text, steps}, where a step is the data of an event
// `tick`; a line out, for each step the active states and the data.  SCION is the folder of its packages.
//
// Two things that SCION does otherwise than the standard's algorithm (appendix D) are mended:
// - states are entered and left in the order of their depth, not in that of the document (entryOrder, exitOrder);
// - a state without children counts as left before its onexit, and other states are active if one without children
//   is active in them, so that In() has another value while states are entered and left (enterStates, exitStates).
const path = require('path');
const packages = path.join(process.env.SCION, '@scion-scxml');
const helpers = require(path.join(packages, 'core-base', 'lib', 'helpers'));
helpers.sortInEntryOrder = (a, b) => a.documentOrder - b.documentOrder;
helpers.getStateWithHigherSourceChildPriority = (a, b) => b.documentOrder - a.documentOrder;
const scxml = require(path.join(packages, 'scxml'));
const { Statechart } = scxml.core;

class Mended extends Statechart {
  isIn(name) { return this.active().has(name); }

  // Listeners are told of an exit before its content runs: the state is left when something else happens.
  active() {
    if (!this.entered) {
      this.entered = new Set();
      const left = () => { this.entered.delete(this.leaving); this.leaving = null; };
      this.on('onExit', (name) => { left(); this.leaving = name; });
      this.on('onTransition', left);
      this.on('onEntry', (name) => { left(); this.entered.add(name); });
    }
    return this.entered;
  }
}

function run({ text, steps }) {
  return new Promise((resolve, reject) => {
    scxml.documentStringToModel('machine.scxml', text, (error, model) => {
      if (error) return reject(error);
      model.prepare((failed, made) => {
        if (failed) return reject(failed);
        const chart = new Mended(made), told = [];
        let fault = null;
        chart.active();
        chart.on('onError', (one) => { fault = fault || one; });
        chart.start();
        for (const data of steps) {
          chart.gen({ name: 'tick', data });
          if (fault) return reject(new Error(JSON.stringify(fault)));
          told.push([chart.getFullConfiguration(), chart.getSnapshot()[3]]);
        }
        resolve(told);
      });
    });
  });
}

(async () => {
  for await (const line of require('readline').createInterface({ input: process.stdin })) {
    let answer;
    try {
      answer = { told: await run(JSON.parse(line)) };
    } catch (error) {
      answer = { error: String((error && (error.stack || error.message)) || error) };
    }
    process.stdout.write(JSON.stringify(answer) + '\n');
  }
})();
