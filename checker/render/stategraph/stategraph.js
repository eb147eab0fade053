"use strict";
// A picture to move about in; what is behind a node is shown when it is chosen.
(() => {
  const begin = (root) => {
    const all = (selector) => [...root.querySelectorAll(selector)];
    const one = (selector) => root.querySelector(selector);
    const { nodes, edges, filters, runs } = JSON.parse(one(".stategraph-data").textContent);
    const stage = one(".sg-stage"), svg = one(".sg-svg"), world = one(".sg-world");
    const boxes = new Map(all(".node").map((g) => [Number(g.dataset.node), g]));
    const lines = all(".edge");
    const size = { width: Number(svg.dataset.width), height: Number(svg.dataset.height) };
    const places = new Map();
    for (const [number, box] of boxes) {
      const r = box.querySelector("rect");
      const [x, y, w, h] = ["x", "y", "width", "height"].map((name) => Number(r.getAttribute(name)));
      places.set(number, { x: x + w / 2, y: y + h / 2 });
    }
    const search = one(".sg-search"), told = one(".sg-hits"), filter = one(".sg-filter"), run = one(".sg-run");
    const alone = root.classList.contains("sg-alone");
    let chosen = null, hits = [], at = -1;

    root.classList.add("sg-live");
    for (const part of all(".sg-bar,.sg-panel")) part.hidden = false;
    svg.removeAttribute("viewBox");
    const zoom = Panzoom(world, { canvas: true, minScale: 0.02, maxScale: 8, step: 0.25, cursor: "grab" });

    // --- the picture ---

    const room = () => stage.getBoundingClientRect();
    const fit = () => {
      const { width, height } = room();
      const scale = Math.min((width - 24) / size.width, (height - 24) / size.height, 1.4);
      zoom.zoom(scale, { animate: false });
      zoom.pan((width / scale - size.width) / 2, (height / scale - size.height) / 2, { animate: false });
    };
    const centre = (number) => {
      const { width, height } = room(), place = places.get(number);
      const scale = Math.max(zoom.getScale(), 0.7);
      zoom.zoom(scale, { animate: false });
      zoom.pan(width / 2 / scale - place.x, height / 2 / scale - place.y, { animate: false });
    };
    const start = () => {
      const least = Math.min(1.4, (room().width - 24) / size.width);
      stage.style.height = `${Math.min(window.innerHeight * 0.66, Math.max(300, size.height * least + 60))}px`;
      fit();
      if (zoom.getScale() >= 0.5) return;
      const first = places.get(nodes.findIndex((node) => node.flags.includes("initial")));
      zoom.zoom(0.7, { animate: false });
      zoom.pan(80 - first.x, Math.min(20, room().height / 2 / 0.7 - first.y), { animate: false });
    };
    const seen = (number) => {
      const box = boxes.get(number).getBoundingClientRect(), outer = room();
      return box.left >= outer.left && box.right <= outer.right && box.top >= outer.top && box.bottom <= outer.bottom;
    };

    // --- the panel ---

    const made = (name, text, classes) => {
      const element = document.createElement(name);
      if (text !== undefined) element.textContent = text;
      if (classes) element.className = classes;
      return element;
    };
    const pairs = (list) => {
      const shown = made("dl");
      for (const [name, value] of list) shown.append(made("dt", name), made("dd", value));
      return shown;
    };
    const counted = (n, word) => `${n.toLocaleString("en")} ${word}${n === 1 ? "" : "s"}`;
    const neighbours = (title, list, other) => {
      const section = made("section"), shown = made("ul");
      section.append(made("h3", `${title} (${list.length})`), shown);
      for (const edge of list) {
        const item = made("li"), button = made("button", nodes[edge[other]].name);
        button.type = "button";
        button.addEventListener("click", () => choose(edge[other], true));
        const behind = nodes[edge.from].valuations;
        const who = edge.sure ? "" : `, from ${edge.sources.toLocaleString("en")} of ${counted(behind, "state")}`;
        const when = edge.ticks.length ? `; in the run shown: tick ${edge.ticks.join(", ")}` : "";
        item.append(button, made("small", `${edge.inputs || "any input"} · ${counted(edge.steps, "pair")}${who}${when}`));
        shown.append(item);
      }
      return section;
    };
    const way = (node) => {
      const section = made("section"), shown = made("div", undefined, "sg-way");
      section.append(made("h3", `A shortest run to ${node.wanted ? "a marked state" : "it"}: ${counted(node.ticks, "tick")} of ${node.tick_ms} ms`));
      for (const [number, ms, texts] of node.way) {
        const cell = made("div");
        for (const text of texts) cell.append(made("div", text, text.startsWith("in ") ? "sg-input" : ""));
        shown.append(made("b", number + (ms ? ` (${ms} ms)` : "")), cell);
      }
      section.append(node.way.length ? shown : made("p", "No tick: a run may start here."));
      return section;
    };
    const panel = (number) => {
      const node = nodes[number], shown = one(".sg-node");
      const facts = [`${counted(node.valuations, "state")} behind it`];
      if (node.wanted) facts.push(`${node.wanted.toLocaleString("en")} of them marked`);
      if (node.dead) facts.push(`${node.dead.toLocaleString("en")} of them admit no input`);
      if (node.unexpanded) facts.push(`the ticks of ${node.unexpanded.toLocaleString("en")} of them are not known`);
      facts.push(`first reached after ${counted(node.depth, "tick")}`);
      if (node.size > 1) facts.push(`one of ${node.size} nodes that can be reached from each other`);
      shown.replaceChildren(made("h2", node.name));
      if (node.flags.length) shown.append(made("p", node.flags.join(", ")));
      shown.append(pairs(node.values), made("p", `${facts.join("; ")}.`));
      shown.append(neighbours("To", edges.filter((e) => e.from === number), "to"));
      shown.append(neighbours("From", edges.filter((e) => e.to === number && e.from !== number), "from"));
      if (node.example.length) {
        shown.append(way(node), made("h3", "The whole state at its end"), pairs(node.example));
      }
      one(".sg-hint").hidden = true;
      one(".sg-panel").scrollTop = 0;
    };

    // --- choosing, searching, filtering ---

    const choose = (number, move) => {
      chosen = number;
      for (const [other, box] of boxes) box.classList.toggle("chosen", other === number);
      for (const line of lines) {
        line.classList.toggle("near", [line.dataset.source, line.dataset.target].includes(String(number)));
      }
      panel(number);
      if (move && (!seen(number) || zoom.getScale() < 0.4)) centre(number);
    };
    const clear = () => {
      chosen = null;
      for (const element of all(".chosen,.near")) element.classList.remove("chosen", "near");
      one(".sg-node").replaceChildren();
      one(".sg-hint").hidden = false;
    };
    // The nodes and edges of a run, the ticks in which it takes each, and where it ends.
    const show = (path) => {
      const taken = new Map();
      path.slice(1).forEach((to, i) => {
        const ends = `${path[i]}>${to}`;
        taken.set(ends, [...(taken.get(ends) || []), i + 1]);
      });
      for (const edge of edges) edge.ticks = taken.get(`${edge.from}>${edge.to}`) || [];
      for (const line of lines) line.classList.toggle("fired", taken.has(`${line.dataset.source}>${line.dataset.target}`));
      for (const [number, box] of boxes) {
        box.classList.toggle("on-path", path.includes(number));
        box.classList.toggle("last", number === path[path.length - 1]);
      }
      clear();
      if (path.length && !seen(path[path.length - 1])) fit();
    };
    const narrow = () => {
      const words = search.value.toLowerCase().split(/\s*[,;]\s*|\s{2,}/).map((w) => w.trim()).filter(Boolean);
      const kept = new Set(filter && filter.value ? filters[filter.value] : boxes.keys());
      const text = (node) => [node.name, ...node.values.map(([n, v]) => `${n} = ${v}`)].join("\n").toLowerCase();
      hits = words.length ? [...kept].filter((n) => words.every((word) => text(nodes[n]).includes(word))) : [];
      at = -1;
      for (const [number, box] of boxes) {
        box.classList.toggle("hit", hits.includes(number));
        box.classList.toggle("dim", !kept.has(number) || (words.length > 0 && !hits.includes(number)));
      }
      for (const line of lines) {
        line.classList.toggle("dim", !kept.has(Number(line.dataset.source)) || !kept.has(Number(line.dataset.target)));
      }
      told.textContent = words.length ? counted(hits.length, "hit") : "";
    };
    const next = () => {
      if (!hits.length) return;
      at = (at + 1) % hits.length;
      told.textContent = `${at + 1} of ${counted(hits.length, "hit")}`;
      choose(hits[at], true);
    };
    const beside = (dx, dy) => {
      if (chosen === null) return choose(0, true);
      const here = places.get(chosen);
      let best = null, least = Infinity;
      for (const [number, there] of places) {
        const along = (there.x - here.x) * dx + (there.y - here.y) * dy;
        const across = Math.abs((there.x - here.x) * dy) + Math.abs((there.y - here.y) * dx);
        if (number !== chosen && along > 1 && along + 2 * across < least) [best, least] = [number, along + 2 * across];
      }
      if (best !== null) choose(best, true);
    };

    // --- what is heard ---

    let down = null;
    stage.addEventListener("pointerdown", (event) => { down = [event.clientX, event.clientY]; }, true);
    stage.addEventListener("click", (event) => {
      const moved = down && Math.hypot(event.clientX - down[0], event.clientY - down[1]) > 5;
      const box = event.target.closest(".node");
      stage.focus({ preventScroll: true });
      if (box && !moved) choose(Number(box.dataset.node), false);
    });
    stage.addEventListener("wheel", (event) => {
      // Whoever scrolls through a long page does not stop at each graph; one that was clicked is meant.
      if (!alone && document.activeElement !== stage && !event.ctrlKey) return;
      event.preventDefault();
      zoom.zoomWithWheel(event);
    }, { passive: false });
    one(".sg-in").addEventListener("click", () => zoom.zoomIn());
    one(".sg-out").addEventListener("click", () => zoom.zoomOut());
    one(".sg-fit").addEventListener("click", fit);
    one(".sg-next").addEventListener("click", next);
    search.addEventListener("input", narrow);
    search.addEventListener("keydown", (event) => { if (event.key === "Enter") next(); });
    if (filter) filter.addEventListener("change", narrow);
    if (run) run.addEventListener("change", () => show(runs[run.value] || []));
    for (const row of all("[data-row]")) {
      row.addEventListener("click", () => {
        choose(Number(row.dataset.row), false);
        centre(Number(row.dataset.row));
        stage.scrollIntoView({ block: "nearest" });
      });
    }
    const keys = {
      ArrowRight: () => beside(1, 0), ArrowLeft: () => beside(-1, 0),
      ArrowUp: () => beside(0, -1), ArrowDown: () => beside(0, 1),
      "+": () => zoom.zoomIn(), "=": () => zoom.zoomIn(), "-": () => zoom.zoomOut(), 0: fit,
      "/": () => search.focus(), n: next,
    };
    stage.addEventListener("keydown", (event) => {
      if (!(event.key in keys) || event.ctrlKey || event.metaKey) return;
      event.preventDefault();
      keys[event.key]();
    });
    root.addEventListener("keydown", (event) => {
      if (event.key !== "Escape") return;
      search.value = "";
      if (filter) filter.value = "";
      narrow();
      clear();
    });
    window.addEventListener("beforeprint", () => {
      svg.setAttribute("viewBox", `0 0 ${size.width} ${size.height}`);
      world.style.transform = "none";
    });
    // Whether it is seen or not: a part of a page may be closed when the window changes, or while it is printed.
    let wide = 0;
    const refit = () => {
      const { width } = room();
      if (!width || width === wide) return;
      if (wide) fit();
      wide = width;
    };
    window.addEventListener("afterprint", () => {
      svg.removeAttribute("viewBox");
      wide = -1;
      refit();
    });
    new ResizeObserver(refit).observe(stage);
    setTimeout(start); // Panzoom puts the picture at its origin once more when this script has run
  };
  const meet = (within) => within.querySelectorAll(".stategraph").forEach(begin);
  meet(document);
  document.addEventListener("page:added", (event) => meet(event.target));
})();
