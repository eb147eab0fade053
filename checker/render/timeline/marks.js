"use strict";
// What stands around the lanes of a timeline: the axis, marks of what is shortened, and the strip of it all.
const timelineMarks = (() => {
  const { make, tip, write, tickAt } = timelineLanes, HEAD = 50;

  /** A box or a zigzag instead of ticks that are not drawn to scale; a click opens it. */
  const stretch = (view, drawing, one) => {
    const left = view.edges[one.first - 1], right = view.edges[one.last], middle = (left + right) / 2;
    const number = view.data.stretches.indexOf(one);
    const whole = make("g", { class: "tl-open", "data-stretch": number }, tip(`${one.what}. Click to unfold.`));
    if (one.kind === "fold") {
      whole.append(make("rect", { x: left + 3, y: 1, width: right - left - 6, height: view.height - 2, rx: 4, class: "tl-fold" }));
      const low = view.height / 2;
      whole.append(write(middle + 4, low, one.told, "tl-fold-text",
        { "text-anchor": "middle", transform: `rotate(-90 ${middle + 4} ${low})` }));
    } else {
      const d = `M${middle} 0` + Array.from({ length: Math.floor(view.height / 6) }, (_, k) => `l${k % 2 ? 4 : -4} 6`).join("");
      whole.append(make("rect", { x: left, y: 0, width: right - left, height: view.height, class: "tl-hover" }));
      for (const [kind, dx] of [["tl-gap", 0], ["tl-cut", -3], ["tl-cut", 3]]) {
        whole.append(make("path", { d, class: kind, transform: `translate(${dx} 0)` }));
      }
    }
    drawing.add(whole);
  };

  /** Numbers and times of ticks, and what is shortened, above the lanes. */
  const scale = (view, labels, from, to) => {
    const group = make("g", {}), middle = { "text-anchor": "middle" };
    for (const [tick, x] of labels) {
      group.append(write(x, HEAD - 18, tick, "tl-tick", middle), write(x, HEAD - 5, view.ms(tick), "tl-ms", middle));
    }
    view.data.stretches.forEach((one, number) => {
      const left = view.edges[one.first - 1], right = view.edges[one.last], x = (left + right) / 2;
      const handle = make("g", { class: "tl-open", "data-stretch": number }, tip(`${one.what}. Click to ${view.opened.has(number) ? "fold" : "unfold"}.`));
      if (view.opened.has(number)) {
        const start = Math.max(left, from), end = Math.min(right, to);
        if (end <= start) return;
        handle.append(make("rect", { x: start, y: 2, width: end - start, height: 15, rx: 3, class: "tl-handle" }));
        if (end - start > 40) handle.append(write((start + end) / 2, 13, end - start > 130 ? `▸◂ fold ${one.first}–${one.last}` : "▸◂", "tl-ms", middle));
      } else if (view.closed.includes(one)) {
        const fold = one.kind === "fold", lines = fold ? [`${one.first}–${one.last}`, `${view.ms(one.first - 1)}–${view.ms(one.last)}`]
          : [`${one.last - one.first + 1} ticks`, "≈"];
        handle.append(make("rect", { x: left, y: 0, width: right - left, height: HEAD, class: "tl-hover" }));
        if (fold) {
          const wide = view.wide - right > 100;
          handle.append(write(wide ? x : left + 3, 13, wide ? `× ${one.times} more` : `× ${one.times}`, "tl-loop-text", wide ? middle : {}));
          group.append(make("path", { d: `M${view.edges[one.first - one.period - 1]} 20v-4H${left - 2}v4`, class: "tl-bracket" }));
        }
        handle.append(write(x, HEAD - 18, lines[0], fold ? "tl-tick" : "tl-ms", middle), write(x, HEAD - 5, lines[1], "tl-ms", middle));
      } else return;
      group.append(handle);
    });
    const told = view.data.loop !== null ? "↻ repeats for ever" : view.data.wrong ? "✗ false here" : "shown here";
    const x = view.data.loop !== null ? Math.max(view.edges[view.data.loop], from) + 4 : view.wide - 2;
    const kind = view.data.loop !== null ? "tl-loop-text" : view.data.wrong ? "tl-fail-text" : "tl-end-text";
    group.append(write(x, 13, told, kind, { "text-anchor": view.data.loop !== null ? "start" : "end" }));
    return group;
  };

  /** The whole run in a strip, to scale, with the part that is seen. */
  const overview = (view) => {
    const strip = view.one("overview"), wide = strip.getBoundingClientRect().width || 600, high = 26, scale = wide / view.count;
    strip.setAttribute("viewBox", `0 0 ${wide} ${high}`);
    const parts = [];
    const block = (first, last, kind) => parts.push(make("rect", {
      x: (first - 1) * scale, y: 0, width: Math.max(1.5, (last - first + 1) * scale), height: high, class: kind }));
    view.data.stretches.forEach((one) => one.kind === "fold" && block(one.first, one.last, "tl-fold"));
    const columns = new Set(view.events.map((tick) => Math.floor((tick - 1) * scale)));
    const d = [...columns].map((x) => `M${x + 0.5} 7V${high - 7}`).join("");
    parts.push(make("path", { d, class: "tl-strip-events" }));
    if (view.data.loop === null) block(view.count, view.count, view.data.wrong ? "tl-strip-fail" : "tl-strip-end");
    else block(view.data.loop + 1, view.count, "tl-strip-loop");
    if (view.second) block(view.second, view.second, "tl-second");
    if (view.tick) block(view.tick, view.tick, "tl-cursor");
    const first = tickAt(view.edges, view.frame.scrollLeft), last = tickAt(view.edges, view.frame.scrollLeft + view.room);
    block(first, last, "tl-window");
    strip.replaceChildren(...parts);
  };

  return { stretch, scale, overview, HEAD };
})();
