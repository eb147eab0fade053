"use strict";
// Plays a trace on its charts.  Every player on the page is one element of class "player" with a block of
// data; a step is a few transitions of one event, and between the steps time may stand at a quiet tick.
(() => {
  const KEYS = { ArrowLeft: "back", ArrowRight: "next", Home: "first", End: "last", " ": "play" };

  // Scroll inside a frame, and not the page, until the marks are seen; sideways only where wanted.
  const scrollTo = (frame, marks, sideways) => {
    const outer = frame.getBoundingClientRect();
    const boxes = marks.map((mark) => mark.getBoundingClientRect());
    const left = Math.min(...boxes.map((box) => box.left));
    const right = Math.max(...boxes.map((box) => box.right));
    const top = Math.min(...boxes.map((box) => box.top));
    const bottom = Math.max(...boxes.map((box) => box.bottom));
    if (sideways && (left < outer.left || right > outer.right)) {
      frame.scrollLeft += (left + right - outer.left - outer.right) / 2;
    }
    if (top < outer.top || bottom > outer.bottom) {
      frame.scrollTop += (top + bottom - outer.top - outer.bottom) / 2;
    }
  };

  class Player {
    constructor(root) {
      this.root = root;
      this.data = JSON.parse(root.querySelector(".player-data").textContent);
      this.figures = [...root.querySelectorAll(".player-chart")];
      this.figures.forEach((figure) => this.fill(figure));
      this.pictures = this.figures.map(fittedPicture);
      this.parts = new Map(this.figures.map((figure) => [figure.dataset.chart, this.index(figure)]));
      this.choices = [...root.querySelectorAll(".player-choice button")];
      this.steps = this.unfolded();
      this.timer = 0;
      if (window.innerWidth <= 700 && this.choices.length) this.press(this.choices[0]);
      this.together = root.closest("[data-together]");
      this.show(0, 0);
      this.follow();
      this.listen();
      root.classList.add("player-ready");
    }

    one(name) {
      return this.root.querySelector(`.player-${name}`);
    }

    // A figure without a picture gets a copy of the one that the page keeps for all players.
    fill(figure) {
      if (figure.querySelector("svg")) return;
      const kept = [...document.querySelectorAll("template.player-picture")];
      const own = kept.find((template) => template.dataset.picture === figure.dataset.picture);
      if (own) figure.append(own.content.cloneNode(true));
    }

    index(figure) {
      const states = new Map();
      const transitions = new Map();
      for (const part of figure.querySelectorAll("[data-state]")) states.set(part.dataset.state, part);
      for (const part of figure.querySelectorAll("[data-arrow]")) {
        const name = part.dataset.arrow;
        transitions.set(name, [...(transitions.get(name) || []), part]);
      }
      return { states, transitions };
    }

    // The data name only the charts that change; here each step knows what is active in all of them.
    unfolded() {
      let active = {};
      return this.data.steps.map((step) => {
        active = { ...active, ...step.active };
        const event = step.event === null ? null : this.data.events[step.event];
        return { ...step, active, told: event, tick: event ? event.tick : 0 };
      });
    }

    listen() {
      for (const name of ["first", "back", "play", "next", "last"]) {
        this.one(name).addEventListener("click", () => this[name]());
      }
      for (const [name, act] of [["out", (one) => one.zoom(1 / 1.4)], ["in", (one) => one.zoom(1.4)], ["fit", (one) => one.fit()]]) {
        this.one(name).addEventListener("click", () => this.pictures.forEach(act));
      }
      this.one("tick").addEventListener("input", (event) => {
        this.seek(Number(event.target.value));
        this.tell();
      });
      this.root.addEventListener("keydown", (event) => this.key(event));
      this.choices.forEach((button) => button.addEventListener("click", () => this.choose(button)));
      if (!this.together) return;
      this.together.addEventListener("page:tick", (event) => event.detail !== this.root && this.follow());
    }

    // What else shows this run, over time say, goes to the tick that was chosen here; and the other way.
    tell() {
      if (!this.together) return;
      this.together.dataset.tick = this.tick;
      this.together.dispatchEvent(new CustomEvent("page:tick", { detail: this.root }));
    }

    follow() {
      const chosen = this.together && this.together.dataset.tick;
      if (chosen) this.seek(Number(chosen));
    }

    key(event) {
      const name = KEYS[event.key];
      const control = event.target.closest("input,select,button,summary");
      if (!name || event.altKey || event.ctrlKey || event.metaKey) return;
      if (control && (event.key === " " || !control.matches("button"))) return;
      event.preventDefault();
      this[name]();
    }

    first() { this.jump(0); }
    last() { this.jump(this.steps.length - 1); }
    next() { this.jump(Math.min(this.at + 1, this.steps.length - 1)); }
    // From a quiet tick back to the event before it.
    back() { this.jump(this.tick > this.steps[this.at].tick ? this.at : Math.max(this.at - 1, 0)); }

    jump(step) {
      this.pause();
      this.go(step);
    }

    go(step) {
      this.show(step, this.steps[step].tick);
      this.tell();
    }

    // As on paper, where nothing plays.
    end() {
      this.pause();
      this.show(this.steps.length - 1, this.steps[this.steps.length - 1].tick);
    }

    // The state after a tick, which may be a quiet one.
    seek(tick) {
      this.pause();
      let step = 0;
      this.steps.forEach((other, i) => { if (other.tick <= tick) step = i; });
      this.show(step, tick);
    }

    play() {
      if (this.timer) return this.pause();
      if (this.at === this.steps.length - 1) this.go(this.again());
      this.one("play").textContent = "Pause";
      this.one("where").setAttribute("aria-live", "off");
      this.timer = setTimeout(() => this.advance(), this.pace());
    }

    pause() {
      clearTimeout(this.timer);
      this.timer = 0;
      this.one("play").textContent = "Play";
      this.one("where").setAttribute("aria-live", "polite");
    }

    pace() { return Number(this.one("speed").value); }

    // Where the run goes on after its end: at the start of its loop, or else at its own start.
    again() {
      if (this.data.loop === null) return 0;
      return this.steps.findIndex((step) => step.tick > this.data.loop);
    }

    advance() {
      const ended = this.at === this.steps.length - 1;
      if (ended && this.data.loop === null) return this.pause();
      this.go(ended ? this.again() : this.at + 1);
      this.timer = setTimeout(() => this.advance(), this.pace());
    }

    show(at, tick) {
      this.at = at;
      this.tick = tick;
      const step = this.steps[at];
      this.one("tick").value = tick;
      this.one("time").textContent = this.where(step);
      this.paint(step);
      this.say(step);
      this.arrange();
    }

    where(step) {
      if (!this.tick) return "Before the first tick";
      const here = `Tick ${this.tick} of ${this.data.ticks} · ${this.data.ms[this.tick] ?? this.tick * this.data.ms} ms`;
      const same = this.steps.filter((other) => other.tick === this.tick);
      if (this.tick > step.tick || same.length < 2) return here;
      return `${here} · step ${same.indexOf(step) + 1} of ${same.length}`;
    }

    // States as after the step; its transitions stand out, those before them in its tick are faint, and so
    // are all of them once time has gone on.
    paint(step) {
      this.moving = new Set();
      for (const [chart, parts] of this.parts) {
        const active = new Set(step.active[chart] || []);
        parts.states.forEach((part, name) => part.classList.toggle("active", active.has(name)));
        parts.transitions.forEach((pieces) => pieces.forEach((piece) => piece.classList.remove("fired", "taken")));
      }
      const transitions = step.told ? step.told.transitions.slice(0, step.last) : [];
      transitions.forEach((transition, i) => this.mark(transition, this.tick === step.tick && i >= step.first));
    }

    mark(transition, now) {
      const parts = this.parts.get(transition.chart);
      if (!parts) return;
      if (now) this.moving.add(transition.chart);
      for (const name of transition.drawn) {
        for (const piece of parts.transitions.get(name) || []) piece.classList.add(now ? "fired" : "taken");
      }
    }

    say(step) {
      const told = this.tick === step.tick ? step.told : null;
      const inputs = told ? told.inputs.map((text) => this.change(`in ${text}`, "player-input")) : [];
      const changes = told ? told.changes.map((text) => this.change(text, "")) : [];
      this.one("changes").replaceChildren(...inputs, ...changes);
      const now = (i) => i >= step.first && i < step.last;
      const transitions = told ? told.transitions.map((transition, i) => this.transition(transition, now(i))) : [];
      this.one("transitions").replaceChildren(...transitions);
      this.one("note").textContent = this.notes(told).join("\n");
      const current = [...this.root.querySelectorAll(".player-transitions [aria-current]")];
      this.one("spoken").textContent = current.map((item) => `: ${item.textContent}`).join("");
      const panel = this.one("said");
      panel.scrollTop = 0;
      if (current.length) scrollTo(panel, current, false);
    }

    change(text, kind) {
      return Object.assign(document.createElement("li"), { textContent: text, className: kind });
    }

    transition(transition, now) {
      const item = document.createElement("li");
      item.append(`${transition.chart}: ${transition.way}`);
      const label = Object.assign(document.createElement("code"), { textContent: transition.label });
      if (transition.label) item.append(" ", label);
      if (now) item.setAttribute("aria-current", "step");
      return item;
    }

    notes(told) {
      const here = ([first, last]) => first <= this.tick && this.tick <= last;
      const notes = this.data.quiet.filter(here).map((row) => row[2]);
      if (told && told.forced.length) notes.push(`Needed for the end: ${told.forced.join(", ")}.`);
      if (this.data.again && this.data.again[0] === this.tick) notes.push(this.data.again[1]);
      if (!this.tick) notes.push("Next (→) steps from transition to transition, Play (space) goes on by itself.");
      return this.tick === this.data.ticks ? [...notes, ...this.data.end] : notes;
    }

    choose(button) {
      this.press(button);
      this.arrange();
    }

    press(button) {
      this.choices.forEach((other) => other.setAttribute("aria-pressed", String(other === button)));
    }

    // Which charts are seen: all, one, or with "Follow" the one whose transition is taken.
    arrange() {
      const pressed = this.choices.find((button) => button.getAttribute("aria-pressed") === "true");
      const wanted = pressed ? pressed.dataset.shown : "*";
      const first = this.figures.map((figure) => figure.dataset.chart)[0];
      this.followed = [...this.moving][0] || this.moved() || first;
      for (const figure of this.figures) {
        const name = figure.dataset.chart;
        figure.hidden = wanted !== "*" && name !== (wanted || this.followed);
        figure.classList.toggle("moves", this.moving.has(name));
        if (!figure.hidden) this.reveal(figure);
      }
      for (const button of this.choices) button.classList.toggle("moves", this.moving.has(button.dataset.shown));
    }

    // The chart whose transition was the last one taken; none before the first.
    moved() {
      const taken = this.steps.slice(0, this.at + 1)
        .flatMap(({ told, first, last }) => (told ? told.transitions.slice(first, last) : []));
      return taken.map((transition) => transition.chart).findLast((chart) => this.parts.has(chart));
    }

    // Scroll inside the figure until what stands out is seen.
    reveal(figure) {
      const marks = [...figure.querySelectorAll(".fired")];
      if (marks.length) scrollTo(figure, marks, true);
    }
  }

  // A player is built when it comes near the window (many may lie in closed parts of a page), or for print.
  // A page that adds players later says so by the event "page:added" at what holds them.
  const waiting = new Map();
  const players = [];
  const build = (root) => {
    if (!waiting.delete(root)) return;
    watch.unobserve(root);
    players.push(new Player(root));
  };
  const watch = new IntersectionObserver(
    (seen) => seen.forEach((entry) => entry.isIntersecting && build(entry.target)),
    { rootMargin: "300px" },
  );
  const meet = (within) => within.querySelectorAll(".player").forEach((root) => {
    waiting.set(root, true);
    watch.observe(root);
  });
  meet(document);
  document.addEventListener("page:added", (event) => meet(event.target));
  let before = [];
  window.addEventListener("beforeprint", () => {
    [...waiting.keys()].forEach(build);
    before = players.map((player) => [player, player.at, player.tick]);
    players.forEach((player) => player.end());
  });
  window.addEventListener("afterprint", () => before.forEach(([player, at, tick]) => player.show(at, tick)));
})();
