"use strict";
(() => {
  const NUMBER = /^(-?[\d.]+)( ?[^\d/].*)?$/;

  /** What a lane shows in a tick; between the ends of a steady count, the number that belongs there. */
  function shown(runs, tick) {
    let low = 0, high = runs.length - 1;
    while (low < high) {
      const middle = (low + high) >> 1;
      if (runs[middle][1] < tick) low = middle + 1; else high = middle;
    }
    const run = runs[low];
    if (!run || tick < run[0] || tick > run[1]) return "";
    return run.length > 3 ? between(run, tick) : run[2];
  }

  function between([first, last, start, end], tick) {
    if (tick === first) return start;
    if (tick === last) return end;
    const share = (tick - first) / (last - first), from = NUMBER.exec(start), to = NUMBER.exec(end);
    if (!from || !to) return `${start} → ${end}`;
    const spans = from[2] !== to[2], [low, high] = [from, to].map(spans ? milliseconds : (read) => Number(read[1]));
    const value = Number((low + (high - low) * share).toFixed(9));
    return spans ? duration(value) : `${value}${from[2] || ""}`;
  }

  /** A timer may rise from 20 ms to 3 s. */
  const milliseconds = ([, number, unit]) => Number(number) * (unit === " s" ? 1000 : 1);
  const duration = (ms) => (ms < 1000 ? `${ms} ms` : `${ms / 1000} s`);

  class Timeline {
    constructor(root) {
      this.root = root;
      this.data = JSON.parse(root.querySelector(".tl-data").textContent);
      this.count = this.data.edges.length - 1;
      this.frame = root.querySelector(".tl-frame");
      this.plot = root.querySelector(".tl-plot");
      this.cursor = root.querySelector(".tl-cursor");
      this.now = root.querySelector(".tl-now");
      this.together = root.closest("[data-together]");
      this.cells = [...root.querySelectorAll(".tl-table tr:not(.tl-still) td")];
      this.events = this.changes();
      if (!this.count) return;
      this.listen();
      this.move(this.count);
      this.pinned = false;
    }

    /** Ticks in which some lane changes other than by a steady count. */
    changes() {
      const ticks = new Set([1, this.count]);
      for (const runs of this.data.lanes) for (const run of runs) ticks.add(run[0]);
      return [...ticks].sort((a, b) => a - b);
    }

    listen() {
      const button = (name, act) => this.root.querySelector(name).addEventListener("click", act);
      button(".tl-first", () => this.go(1));
      button(".tl-back", () => this.go(this.tick - 1));
      button(".tl-next", () => this.go(this.tick + 1));
      button(".tl-last", () => this.go(this.count));
      this.plot.addEventListener("pointermove", (event) => {
        if (event.pointerType === "mouse" && !this.pinned) this.show(this.at(event));
      });
      this.plot.addEventListener("click", (event) => {
        const tick = this.at(event);
        this.pinned = !(this.pinned && tick === this.tick);
        this.show(tick);
        this.tell();
      });
      this.frame.addEventListener("keydown", (event) => this.key(event));
      if (this.together) this.together.addEventListener("page:tick", (event) => this.follow(event));
    }

    /** What else shows this run, on the charts say, goes to the tick that was chosen here. */
    tell() {
      if (!this.together) return;
      this.together.dataset.tick = this.tick;
      this.together.dispatchEvent(new CustomEvent("page:tick", { detail: this.root }));
    }

    follow(event) {
      if (event.detail === this.root) return;
      this.now.setAttribute("aria-live", "off");
      this.move(Number(this.together.dataset.tick));
    }

    key(event) {
      const before = this.events.filter((tick) => tick < this.tick), after = this.events.find((tick) => tick > this.tick);
      const where = {
        ArrowLeft: this.tick - 1, ArrowRight: this.tick + 1, Home: 1, End: this.count,
        ArrowUp: before[before.length - 1] || 1, ArrowDown: after || this.count,
      }[event.key];
      if (where === undefined || event.ctrlKey || event.altKey || event.metaKey) return;
      event.preventDefault();
      this.go(where);
    }

    /** The tick under the pointer. */
    at(event) {
      const box = this.plot.getBoundingClientRect(), wide = this.plot.viewBox.baseVal.width;
      const x = (event.clientX - box.left) * wide / box.width;
      let tick = 1;
      while (tick < this.count && this.data.edges[tick] <= x) tick += 1;
      return tick;
    }

    go(tick) {
      this.now.setAttribute("aria-live", "polite");
      this.move(Math.max(1, tick));
      this.tell();
    }

    /** Moves the cursor there, and the lanes so that it is seen; 0 is before the first tick. */
    move(tick) {
      this.pinned = true;
      this.show(tick);
      const left = this.data.edges[Math.max(0, this.tick - 1)], right = this.data.edges[this.tick];
      const room = this.frame.clientWidth - this.frame.querySelector(".tl-names").offsetWidth;
      if (left < this.frame.scrollLeft) this.frame.scrollLeft = left - 20;
      else if (right > this.frame.scrollLeft + room) this.frame.scrollLeft = right - room + 20;
    }

    show(tick) {
      this.tick = Math.max(0, Math.min(this.count, tick));
      const left = this.data.edges[Math.max(0, this.tick - 1)];
      this.cursor.setAttribute("x", left);
      this.cursor.setAttribute("width", this.data.edges[this.tick] - left);
      this.now.textContent = this.tick ? `tick ${this.tick}\n${this.data.ms[this.tick] ?? this.tick * this.data.ms} ms` : "before the\nfirst tick";
      this.data.lanes.forEach((runs, place) => {
        const now = shown(runs, this.tick), cell = this.cells[place];
        cell.replaceChildren(...now.split(/(?<=_)/).flatMap((piece) => [piece, document.createElement("wbr")]));
        cell.parentElement.classList.toggle("tl-new", this.tick > 1 && now !== shown(runs, this.tick - 1));
      });
    }
  }

  const begin = (within) => within.querySelectorAll(".tl").forEach((root) => new Timeline(root));
  begin(document);
  document.addEventListener("page:added", (event) => begin(event.target));

  let closed = [];
  window.addEventListener("beforeprint", () => {
    closed = [...document.querySelectorAll(".tl-same:not([open])")];
    closed.forEach((details) => { details.open = true; });
  });
  window.addEventListener("afterprint", () => closed.forEach((details) => { details.open = false; }));
})();
