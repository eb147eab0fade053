"use strict";
(() => {
  const { make, place, fit, pieces, labelled, tickAt, Drawing, TITLE, GAP } = timelineLanes;
  const { stretch, scale, overview, HEAD } = timelineMarks;
  const NUMBER = /^(-?[\d.]+)( ?[^\d/].*)?$/, ZOOM = 1.5, WIDEST = 400;

  /** What a lane shows in a tick; between the ends of a steady count, the number that belongs there. */
  function shown(runs, tick) {
    let low = 0, high = runs.length - 1;
    while (low < high) {
      const middle = (low + high) >> 1;
      if (runs[middle][1] < tick) low = middle + 1; else high = middle;
    }
    const run = runs[low];
    if (!run || tick < run[0] || tick > run[1]) return "";
    return run.length > 6 ? between(run, tick) : run[2];
  }

  function between([first, last, start, , , , end], tick) {
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

  /** The number of the stretch that an event is on; null if there is none. */
  const stretchAt = (event) => {
    const one = event.target.closest("[data-stretch]");
    return one && Number(one.dataset.stretch);
  };

  class Timeline {
    constructor(root) {
      this.root = root;
      this.data = JSON.parse(this.one("data").textContent);
      this.count = this.data.count;
      this.frame = this.one("frame");
      this.plot = this.one("plot");
      this.axis = this.one("axis");
      this.names = this.one("names");
      this.now = this.one("now");
      this.together = root.closest("[data-together]");
      this.rows = [...this.names.querySelectorAll(".tl-lane")];
      this.cells = this.rows.map((row) => [...row.querySelectorAll(".tl-cell")]);
      this.choices = [...root.querySelectorAll(".tl-list li input")];
      this.opened = new Set();
      this.fitted = true;
      this.unit = 1;
      this.second = 0;
      this.events = this.changes();
      if (!this.count) return;
      root.classList.add("tl-ready");
      this.tick = this.count;
      this.arrange();
      this.listen();
      this.move(this.count);
      this.pinned = false;
      if (this.together && !this.together.dataset.tick) this.tell();
    }

    one(name) { return this.root.querySelector(`.tl-${name}`); }
    ms(tick) { return this.data.ms[tick] ?? tick * this.data.ms; }

    /** Ticks in which some lane changes other than by a steady count. */
    changes() {
      const ticks = new Set([1, this.count]);
      for (const lane of this.data.lanes) for (const run of lane.runs) ticks.add(run[0]);
      return [...ticks].sort((a, b) => a - b);
    }

    listen() {
      const button = (name, act) => this.one(name).addEventListener("click", act);
      button("first", () => this.go(1));
      button("back", () => this.go(this.tick - 1));
      button("next", () => this.go(this.tick + 1));
      button("last", () => this.go(this.count));
      button("in", () => this.zoom(ZOOM));
      button("out", () => this.zoom(1 / ZOOM));
      button("fit", () => { this.fitted = true; this.layout(); });
      button("mark", () => this.mark(this.second ? 0 : this.tick));
      button("every", () => this.choose(() => true));
      button("none", () => this.choose(() => false));
      this.choices.forEach((box) => box.addEventListener("change", () => this.arrange()));
      this.one("filter").addEventListener("input", (event) => this.filter(event.target.value));
      [...this.root.querySelectorAll(".tl-fold-button")].forEach((fold, i) => (
        fold.addEventListener("click", () => this.toggle(this.data.stretches.findIndex((one) => one.fold === i)))));
      this.plot.addEventListener("pointermove", (event) => {
        if (event.pointerType === "mouse" && !this.pinned) this.show(this.at(event));
      });
      this.plot.addEventListener("click", (event) => this.click(event));
      this.axis.addEventListener("click", (event) => this.toggled(event));
      for (const place of [this.plot, this.axis]) {
        place.addEventListener("pointerdown", (event) => { this.pressed = stretchAt(event); this.taken = false; });
        place.addEventListener("pointerup", (event) => this.released(event));
      }
      this.frame.addEventListener("keydown", (event) => this.key(event));
      this.frame.addEventListener("scroll", () => this.later());
      zoomable(this.frame, (factor, x) => this.zoom(factor, x));
      const strip = this.one("overview"), drag = (event) => event.buttons && this.look(event);
      strip.addEventListener("pointerdown", (event) => { strip.setPointerCapture(event.pointerId); this.look(event); });
      strip.addEventListener("pointermove", drag);
      new ResizeObserver(() => this.resized()).observe(this.frame);
      if (this.together) this.together.addEventListener("page:tick", (event) => this.follow(event));
    }

    click(event) {
      if (this.toggled(event)) return;
      const tick = this.at(event);
      if (event.shiftKey) return this.mark(tick);
      this.pinned = !(this.pinned && tick === this.tick);
      this.show(tick);
      this.tell();
    }

    /** Whether a stretch that is shortened was clicked at, which opens, or the mark that shortens it again. */
    toggled(event) {
      if (event.detail && this.taken) return true;
      const one = stretchAt(event);
      if (one !== null) this.toggle(one);
      return one !== null;
    }

    /** A mark that is drawn anew between press and release gets no click: both are on the same stretch. */
    released(event) {
      const one = event.button ? null : stretchAt(event);
      if (one === null || one !== this.pressed) return;
      this.taken = true;
      this.toggle(one);
    }

    toggle(number) {
      const { first, fold } = this.data.stretches[number], opened = !this.opened.has(number);
      if (opened) this.opened.add(number); else this.opened.delete(number);
      const button = this.root.querySelectorAll(".tl-fold-button")[fold];
      if (button) button.setAttribute("aria-expanded", String(opened));
      if (opened && this.fitted) this.fitted = false;
      else if (!this.opened.size) this.fitted = true;
      this.layout();
      if (opened) this.frame.scrollLeft = this.edges[first - 1] - 60;
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
      const act = {
        "+": () => this.zoom(ZOOM), "-": () => this.zoom(1 / ZOOM), 0: () => this.one("fit").click(),
        b: () => this.mark(this.tick), Escape: () => this.mark(0),
      }[event.key];
      if ((where === undefined && !act) || event.ctrlKey || event.altKey || event.metaKey) return;
      event.preventDefault();
      if (act) act(); else this.go(where);
    }

    /** The tick under the pointer. */
    at(event) { return tickAt(this.edges, event.clientX - this.plot.getBoundingClientRect().left); }

    go(tick) {
      this.now.setAttribute("aria-live", "polite");
      this.move(Math.max(1, tick));
      this.tell();
    }

    /** Moves the cursor there, and the lanes so that it is seen; 0 is before the first tick. */
    move(tick) {
      this.pinned = true;
      this.show(tick);
      const left = this.edges[Math.max(0, this.tick - 1)], right = this.edges[this.tick];
      if (left < this.frame.scrollLeft) this.frame.scrollLeft = left - 20;
      else if (right > this.frame.scrollLeft + this.room) this.frame.scrollLeft = right - this.room + 20;
    }

    show(tick) {
      this.tick = Math.max(0, Math.min(this.count, tick));
      this.now.textContent = this.tick ? `tick ${this.tick}\n${this.ms(this.tick)} ms` : "before the\nfirst tick";
      this.values();
      this.cursors();
    }

    values() {
      this.data.lanes.forEach(({ runs }, i) => {
        const [cell, other] = this.cells[i], now = shown(runs, this.tick);
        cell.textContent = now;
        cell.title = now;
        other.textContent = this.second ? shown(runs, this.second) : "";
        cell.classList.toggle("tl-new", this.tick > 1 && now !== shown(runs, this.tick - 1));
        other.classList.toggle("tl-differs", other.textContent !== now);
      });
    }

    /** The second cursor, from which the first one is measured; 0 takes it away. */
    mark(tick) {
      this.second = tick;
      const button = this.one("mark");
      button.setAttribute("aria-pressed", String(Boolean(tick)));
      this.root.classList.toggle("tl-two", Boolean(tick));
      this.values();
      this.resized();
    }

    cursors() {
      const at = (element, tick) => {
        const left = this.edges[Math.max(0, tick - 1)];
        element.setAttribute("x", left);
        element.setAttribute("width", tick ? this.edges[tick] - left : 0);
      };
      for (const [name, tick] of [["cursor", this.tick], ["second", this.second]]) {
        this.root.querySelectorAll(`.tl-${name}`).forEach((element) => at(element, tick));
      }
      const ticks = this.tick - this.second, ms = this.ms(this.tick) - this.ms(this.second);
      this.one("difference").textContent = this.second
        ? `B tick ${this.second}, ${this.ms(this.second)} ms; A − B = ${ticks} tick${Math.abs(ticks) === 1 ? "" : "s"}, ${ms} ms`
        : "";
      overview(this);
    }

    choose(wanted) {
      this.choices.forEach((box) => { if (!box.closest("li").hidden) box.checked = wanted(box); });
      this.arrange();
    }

    filter(words) {
      this.choices.forEach((box) => {
        const item = box.closest("li");
        item.hidden = !item.textContent.toLowerCase().includes(words.toLowerCase());
      });
    }

    /** Puts the lanes that are chosen below each other. */
    arrange() {
      const heads = [...this.names.querySelectorAll(".tl-head")];
      let top = 0, group = "";
      this.tops = [];
      this.tall = [];
      heads.forEach((head) => { head.hidden = true; });
      this.data.lanes.forEach((lane, i) => {
        const chosen = this.choices[i].checked;
        this.rows[i].hidden = !chosen;
        this.tops.push(chosen ? top : -1);
        if (!chosen) return;
        if (lane.group !== group) {
          const head = heads.find((one) => one.dataset.group === lane.group);
          head.hidden = false;
          head.style.top = `${top}px`;
          group = lane.group;
          top += TITLE;
          this.tops[i] = top;
        }
        this.rows[i].style.top = `${top}px`;
        this.rows[i].style.height = "auto";
        this.tall[i] = Math.max(lane.tall, this.rows[i].offsetHeight + 2);
        this.rows[i].style.height = `${this.tall[i]}px`;
        top += this.tall[i] + GAP;
      });
      this.height = top + GAP;
      this.names.style.height = `${this.height}px`;
      const count = this.choices.filter((box) => box.checked).length;
      this.one("chosen").textContent = `${count} of ${this.choices.length}`;
      this.layout();
    }

    zoom(factor, x) {
      const box = this.plot.getBoundingClientRect();
      const cursor = (this.edges[Math.max(0, this.tick - 1)] + this.edges[this.tick]) / 2;
      const at = x === undefined ? cursor - this.frame.scrollLeft : x - box.left - this.frame.scrollLeft;
      const before = this.frame.scrollLeft + at, tick = tickAt(this.edges, before);
      const share = (before - this.edges[tick - 1]) / (this.edges[tick] - this.edges[tick - 1]);
      const least = fit(this.count, this.data.stretches, this.opened, this.room);
      this.unit = Math.min(WIDEST, Math.max(least, this.unit * factor));
      this.fitted = this.unit === least;
      this.layout();
      this.frame.scrollLeft = this.edges[tick - 1] + share * (this.edges[tick] - this.edges[tick - 1]) - at;
    }

    /** Names take more lines where their column is narrower. */
    resized() {
      if (this.narrow === this.names.offsetWidth) return this.layout();
      this.narrow = this.names.offsetWidth;
      this.arrange();
    }

    layout() {
      this.room = Math.max(60, this.frame.clientWidth - this.names.offsetWidth - 2);
      if (this.fitted) this.unit = fit(this.count, this.data.stretches, this.opened, this.room);
      const { edges, closed } = place(this.count, this.data.stretches, this.opened, this.unit);
      this.edges = edges;
      this.closed = closed;
      const folds = closed.filter((one) => one.kind === "fold");
      this.pieces = this.data.lanes.map((lane) => pieces(lane.runs, folds));
      this.hidden = (tick) => folds.some((one) => one.first <= tick && tick <= one.last);
      this.wide = edges[this.count];
      for (const [svg, high] of [[this.plot, this.height], [this.axis, HEAD]]) {
        svg.setAttribute("width", this.wide);
        svg.setAttribute("height", high);
        svg.setAttribute("viewBox", `0 0 ${this.wide} ${high}`);
      }
      this.draw();
      this.cursors();
    }

    later() {
      if (this.waiting) return;
      this.waiting = requestAnimationFrame(() => { this.waiting = 0; this.draw(); overview(this); });
    }

    draw() {
      const from = this.frame.scrollLeft, to = Math.min(this.wide, from + this.room);
      const drawing = new Drawing(this.edges, this.closed, from, to), loop = this.data.loop;
      if (loop !== null) {
        drawing.add(make("rect", { x: this.edges[loop], y: 0, width: this.wide - this.edges[loop], height: this.height, class: "tl-loop" }));
      }
      const labels = labelled(this.edges, this.closed, (tick) => this.ms(tick), from, to);
      for (const [tick] of labels) drawing.add(make("path", { d: `M${this.edges[tick - 1]} 0V${this.height}`, class: "tl-grid" }));
      this.data.lanes.forEach((lane, i) => {
        if (this.tops[i] < 0) return;
        const needed = lane.needed.filter(([first, last]) => !(this.hidden(first) && this.hidden(last)));
        const shots = lane.shots.filter(([tick]) => !this.hidden(tick));
        drawing.lane({ ...lane, needed, shots }, this.pieces[i], this.tops[i], this.tall[i]);
      });
      for (const one of this.closed) stretch(this, drawing, one);
      if (loop === null) {
        const x = this.edges[this.count - 1];
        drawing.add(make("rect", { x, y: 1, width: Math.max(2, this.wide - x - 1), height: this.height - 2,
          class: this.data.wrong ? "tl-fail" : "tl-end" }));
      }
      for (const kind of ["cursor", "second"]) {
        drawing.add(make("rect", { class: `tl-${kind}`, y: 0, width: 0, height: this.height }));
      }
      this.plot.replaceChildren(drawing.group);
      this.axis.replaceChildren(scale(this, labels, from, to));
      this.cursors();
    }

    /** Moves what is seen to the place in the strip. */
    look(event) {
      const box = this.one("overview").getBoundingClientRect();
      const tick = Math.max(1, Math.min(this.count, Math.ceil((event.clientX - box.left) / box.width * this.count)));
      this.frame.scrollLeft = this.edges[tick] - this.room / 2;
      this.later();
    }

    /** As on paper: everything that there is, as wide as the page. */
    print(room) {
      this.kept = [this.unit, this.fitted];
      this.root.style.setProperty("--tl-wide", `${room}px`);
      this.root.classList.add("tl-printed");
      this.fitted = true;
      this.layout();
    }

    printed() {
      this.root.classList.remove("tl-printed");
      [this.unit, this.fitted] = this.kept;
      this.layout();
    }
  }

  const every = [];
  const begin = (within) => within.querySelectorAll(".tl").forEach((root) => every.push(new Timeline(root)));
  begin(document);
  document.addEventListener("page:added", (event) => begin(event.target));

  let closed = [];
  window.addEventListener("beforeprint", () => {
    closed = [...document.querySelectorAll(".tl-same:not([open])")];
    closed.forEach((details) => { details.open = true; });
    every.forEach((one) => one.count && one.root.isConnected && one.print(690));
  });
  window.addEventListener("afterprint", () => {
    closed.forEach((details) => { details.open = false; });
    every.forEach((one) => one.kept && one.printed());
  });
})();
