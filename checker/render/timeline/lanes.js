"use strict";
// Draws the lanes of a timeline, as far as they are seen: what the picture on paper shows, at any zoom.
const timelineLanes = (() => {
  const SVG = "http://www.w3.org/2000/svg", SMALL = 10, STAIR = 5, TITLE = 22, GAP = 4;
  const PX = { fold: 90, quiet: 56 };

  const make = (name, attributes, ...inside) => {
    const element = document.createElementNS(SVG, name);
    for (const [key, value] of Object.entries(attributes)) element.setAttribute(key, value);
    element.append(...inside);
    return element;
  };
  const tip = (words) => make("title", {}, words);
  const write = (x, y, words, kind, more = {}) => make("text", { x, y, class: kind, ...more }, words);

  const widths = new Map(), measure = document.createElement("canvas").getContext("2d");
  const width = (words) => {
    if (!widths.has(words)) {
      measure.font = `${SMALL}px "DejaVu Sans",Verdana,Helvetica,Arial,sans-serif`;
      widths.set(words, measure.measureText(words).width);
    }
    return widths.get(words);
  };
  const fitting = (words, room) => {
    if (width(words) <= room) return words;
    for (let n = Math.floor(words.length * room / width(words)); n >= 4; n -= 1) {
      if (width(`${words.slice(0, n)}…`) <= room) return `${words.slice(0, n)}…`;
    }
    return "";
  };

  /** Where ticks are: `unit` pixels for each, closed stretches as wide as their mark. */
  const place = (count, stretches, opened, unit) => {
    const edges = new Float64Array(count + 1), step = new Float64Array(count + 1).fill(unit);
    const closed = stretches.filter((one, i) => !opened.has(i) && (one.last - one.first + 1) * unit > PX[one.kind]);
    for (const one of closed) {
      step.fill(PX[one.kind] / (one.last - one.first + 1), one.first, one.last + 1);
    }
    for (let tick = 1; tick <= count; tick += 1) edges[tick] = edges[tick - 1] + step[tick];
    return { edges, closed };
  };

  /** The pixels of a tick with which all of a run fits into `room`, found by halving. */
  const fit = (count, stretches, opened, room) => {
    const closed = stretches.filter((_, i) => !opened.has(i)).map((one) => [one.last - one.first + 1, PX[one.kind]]);
    const rest = count - closed.reduce((sum, [length]) => sum + length, 0);
    const total = (unit) => closed.reduce((sum, [length, mark]) => sum + Math.min(length * unit, mark), rest * unit);
    let low = 0, high = 240;
    if (total(high) <= room) return high;
    for (let i = 0; i < 40; i += 1) {
      const middle = (low + high) / 2;
      if (total(middle) > room) high = middle; else low = middle;
    }
    return low;
  };

  /** The runs of a lane outside closed folds: [first, last, label, tone, low, high]. */
  const pieces = (runs, folds) => {
    let found = runs.map(([first, last, label, tone, low, high, until]) => (
      { first, last, label: until ? `${label} → ${until}` : label, tone, low, high }));
    for (const fold of folds) {
      found = found.flatMap((run) => [[1, fold.first - 1], [fold.last + 1, Infinity]].flatMap(([from, to]) => {
        const first = Math.max(run.first, from), last = Math.min(run.last, to);
        if (first > last) return [];
        if (first === run.first && last === run.last) return [run];
        const slope = (run.high - run.low) / Math.max(1, run.last - run.first);
        const label = run.low === run.high ? run.label : "";
        return [{ ...run, first, last, label, low: run.low + slope * (first - run.first),
          high: run.low + slope * (last - run.first) }];
      }));
    }
    return found;
  };

  /** Slanted strokes within a box, each cut at its sides. */
  const hatch = (x, y, right, bottom) => {
    const tall = bottom - y, strokes = [];
    for (let start = Math.floor(x) - tall; start < right; start += 6) {
      const a = Math.max(start, x), b = Math.min(start + tall, right);
      if (b - a > 1) strokes.push(`M${a} ${bottom - (a - start)}L${b} ${bottom - (b - start)}`);
    }
    return strokes.join("");
  };

  /** Draws the lanes between two edges of what is seen into one group. */
  class Drawing {
    constructor(edges, closed, from, to) {
      this.edges = edges;
      this.cuts = closed.map((one) => (edges[one.first - 1] + edges[one.last]) / 2);
      this.from = from;
      this.to = to;
      this.group = make("g", {});
    }

    left(tick) { return this.edges[tick - 1]; }
    right(tick) { return this.edges[tick]; }
    add(...elements) { this.group.append(...elements); }
    seen(first, last) { return this.right(last) >= this.from && this.left(first) <= this.to; }

    /** Where words begin that would else be cut by the mark of a shortened stretch. */
    clear(at, room) {
      for (const cut of this.cuts) if (at < cut + 8 && at + room > cut - 8) return cut + 10;
      return at;
    }

    lane(lane, runs, top, tall) {
      if (lane.kind === "band" || lane.kind === "truth") this.bands(runs, top + 2, tall - 4);
      else this.graph(lane, runs, top, tall);
      for (const [first, last, words] of lane.needed) {
        if (!this.seen(first, last)) continue;
        this.add(make("rect", { x: this.left(first), y: top + 1, width: this.right(last) - this.left(first),
          height: tall - 2, class: "tl-needed" }, tip(words)));
      }
      let free = -Infinity;
      for (const [tick, words] of lane.shots) {
        const x = this.left(tick);
        if (!this.seen(tick, tick) || x < free) continue;
        free = x + 3;
        this.add(make("path", { d: `M${x - 4} ${top - 2}h8l-4 7z`, class: "tl-shot" }, tip(`tick ${tick}: ${words}`)));
      }
    }

    bands(runs, y, tall) {
      let free = -Infinity;
      for (const run of runs) {
        const left = this.left(run.first), right = this.right(run.last);
        if (!this.seen(run.first, run.last) || right < free) continue;
        free = right + 0.75;
        this.add(make("rect", { x: left, y, width: Math.max(right - left, 0.75), height: tall, class: `tl-is-${run.tone}` }));
        let at = Math.max(left, this.from) + 4, label = fitting(run.label, right - at - 4);
        const clear = this.clear(at, width(label));
        if (clear !== at) [at, label] = [clear, fitting(run.label, right - clear - 4)];
        if (run.tone === "degraded") {
          const x = label ? at + width(label) + 4 : left;
          if (right > x) this.add(make("path", { d: hatch(x, y, Math.min(right, this.to), y + tall), class: "tl-hatch" }));
        }
        if (label) this.add(write(at, y + tall / 2 + 4, label, `tl-label tl-on-${run.tone}`));
      }
    }

    graph(lane, runs, top, tall) {
      const [low, high] = lane.reach, line = lane.kind === "line";
      const head = top + (line ? 16 : 8), foot = top + tall - 6;
      const y = (value) => foot - (value - low) / (high - low) * (foot - head);
      const end = this.right(this.edges.length - 1);
      this.add(make("path", { d: `M0 ${foot + 2}H${end}`, class: "tl-base" }));
      for (const [value] of lane.limits) this.add(make("path", { d: `M0 ${y(value)}H${end}`, class: "tl-limit" }));
      let d = "", last = 0;
      for (const run of runs) {
        if (!this.seen(run.first, run.last)) continue;
        const points = this.points(run, y).map(([x, at]) => `${x.toFixed(1)} ${at.toFixed(1)}`).join("L");
        d += `${d && run.first === last + 1 ? "L" : "M"}${points}`;
        if (!line && run.high) {
          this.add(make("path", { class: "tl-ramp",
            d: `M${this.left(run.first)} ${foot}L${points}L${this.right(run.last)} ${foot}Z` }));
        }
        last = run.last;
      }
      this.add(make("path", { d, class: "tl-curve" }));
      this.values(lane, runs, y, top, line);
      let lowest = Infinity;
      for (const [value, words] of lane.limits) {
        lowest = Math.min(y(value) - 2, lowest - 11);
        this.add(write(Math.min(this.to, end) - 3, Math.max(lowest, top + 9), words, "tl-bound", { "text-anchor": "end" }));
      }
    }

    points(run, y) {
      const narrow = this.right(run.last) - this.left(run.first) < STAIR * (run.last - run.first + 1);
      if (run.low === run.high || narrow) return [[this.left(run.first), y(run.low)], [this.right(run.last), y(run.high)]];
      const found = [], from = Math.max(run.first, this.tick(this.from)), to = Math.min(run.last, this.tick(this.to) + 1);
      for (let tick = from; tick <= to; tick += 1) {
        const at = y(run.low + (run.high - run.low) * (tick - run.first) / (run.last - run.first));
        found.push([this.left(tick), at], [this.right(tick), at]);
      }
      return found;
    }

    values(lane, runs, y, top, line) {
      let free = this.from;
      for (const run of runs) {
        if (!run.label || !this.seen(run.first, run.last) || (!line && !run.high)) continue;
        const room = width(run.label), at = this.clear(Math.max(this.left(run.first), this.from) + 3, room);
        if (at < free || at + room > this.right(run.last)) continue;
        const height = line ? Math.min(y(run.low), y(run.high)) : top + 20;
        this.add(write(at, Math.max(height - 4, top + 9), run.label, "tl-value"));
        free = at + room + 4;
      }
    }

    /** The tick at a place across. */
    tick(x) { return tickAt(this.edges, x); }
  }

  const tickAt = (edges, x) => {
    let low = 1, high = edges.length - 1;
    while (low < high) {
      const middle = (low + high) >> 1;
      if (edges[middle] <= x) low = middle + 1; else high = middle;
    }
    return low;
  };

  /** Ticks whose number is written: the ends, those beside a closed stretch, and others with room. */
  const labelled = (edges, closed, ms, from, to) => {
    const count = edges.length - 1, first = tickAt(edges, from), last = tickAt(edges, to);
    const taken = closed.map((one) => [edges[one.first - 1], edges[one.last]]), found = [];
    const wanted = [1, count, ...closed.flatMap((one) => [one.last + 1, one.first - 1])];
    for (const step of [10000, 5000, 2000, 1000, 500, 200, 100, 50, 20, 10, 5, 2, 1]) {
      if ((last - first) / step > 400) break;
      for (let tick = Math.ceil(first / step) * step; tick <= last; tick += step) wanted.push(tick);
    }
    for (const tick of new Set(wanted)) {
      if (tick < first || tick > last) continue;
      const half = width(String(ms(tick))) / 2 + 5, centre = (edges[tick - 1] + edges[tick]) / 2;
      const middle = tick === first || tick === last ? Math.max(from + half, Math.min(to - half, centre)) : centre;
      if (taken.some(([a, b]) => middle + half > a && middle - half < b)) continue;
      taken.push([middle - half, middle + half]);
      found.push([tick, middle]);
    }
    return found;
  };

  return { make, tip, write, width, place, fit, pieces, labelled, tickAt, Drawing, TITLE, GAP };
})();
