"use strict";
// The live page: everything it shows comes from its own server, in answer to requests by name.
(() => {
  const byId = (id) => document.getElementById(id);
  const make = (tag, options = {}, ...children) => {
    const made = document.createElement(tag);
    for (const [name, value] of Object.entries(options)) {
      if (name === "class") made.className = value;
      else if (name === "text") made.textContent = value;
      else if (name.startsWith("on")) made.addEventListener(name.slice(2), value);
      else if (value !== false && value !== null) made.setAttribute(name, value === true ? "" : value);
    }
    made.append(...children);
    return made;
  };
  const fill = (id, children) => byId(id).replaceChildren(...children);
  const show = (id, shown) => { byId(id).hidden = !shown; };

  let overview = null;
  let at = null;           // the session as it was told last
  let pictures = null;     // of the system of that session
  let figures = new Map();
  let chosenChart = "";    // "": follow, "*": all, or a chart
  let followed = "";
  let picked = [];         // steps that are to happen together
  let listed = "systems";
  let job = null;
  let waiting = Promise.resolve();

  // --- asking the server ---

  const ask = async (name, given = {}) => {
    let reply;
    try {
      reply = await fetch(`api/${name}`, {
        method: "POST", headers: { "Content-Type": "application/json" }, body: JSON.stringify(given),
      });
    } catch {
      lost(true);
      throw new Error("The server does not answer: rovercheck serve has ended, or cannot be reached.");
    }
    lost(false);
    const told = await reply.json();
    if (!reply.ok) throw new Error(told.error);
    return told;
  };

  const lost = (is) => {
    byId("connection").textContent = is ? "not connected" : "";
    byId("connection").classList.toggle("violated", is);
  };

  const failed = (error) => {
    byId("error").textContent = error.message;
    show("error", true);
  };

  // One thing after the other, as it was asked for; what goes wrong is said, and what is shown stays.
  const act = (work) => {
    waiting = waiting.then(async () => {
      document.body.setAttribute("aria-busy", "true");
      try {
        await work();
        show("error", false);
      } catch (error) {
        failed(error);
      }
      document.body.removeAttribute("aria-busy");
    });
    return waiting;
  };

  const move = (name, given = {}) => act(async () => {
    const told = await ask(name, { session: at.session, ...given });
    if (told.job) follow(told);
    else await shown(told);
  });

  // --- the list at the side ---

  const matches = (text) => byId("filter").value.toLowerCase().split(/\s+/)
    .every((word) => text.toLowerCase().includes(word));

  const drawList = () => {
    if (!overview) return;
    for (const name of ["systems", "properties"]) {
      const tab = byId(`tab-${name}`);
      tab.setAttribute("aria-selected", String(listed === name));
      tab.tabIndex = listed === name ? 0 : -1;
    }
    byId("list").setAttribute("aria-labelledby", `tab-${listed}`);
    show("only-findings-label", listed === "properties");
    show("only-here-label", listed === "properties" && at !== null);
    fill("list", listed === "systems" ? systemRows() : propertyRows());
  };

  // What is called so comes before what begins so, and what only mentions it.
  const rank = (name, wanted) => [name.toLowerCase() === wanted, name.toLowerCase().startsWith(wanted),
    name.toLowerCase().includes(wanted), true].indexOf(true);

  const systemRows = () => {
    const rows = (title, all) => {
      const found = all.filter((one) => matches(`${one.name} ${one.text}`));
      const wanted = byId("filter").value.trim().toLowerCase();
      found.sort((one, other) => rank(one.name, wanted) - rank(other.name, wanted));
      return found.length ? [make("h3", { text: title }), ...found.map(systemRow)] : [];
    };
    const found = [...rows("Systems", overview.systems), ...rows("Charts, each alone", overview.charts)];
    return found.length ? found : [make("p", { class: "soft", text: "Nothing is called so." })];
  };

  const systemRow = (one) => make("button", {
    class: "row", type: "button", "aria-current": String(at !== null && at.system === one.name),
    onclick: () => open(one.name),
  }, one.name, make("small", { text: one.text.length > 110 ? `${one.text.slice(0, 108)}…` : one.text }));

  const isFinding = (one) => (one.decided || one.expected) === "violated";

  const propertyRows = () => {
    const findings = byId("only-findings").checked;
    const here = byId("only-here").checked && at !== null;
    const found = overview.properties.filter((one) => matches(`${one.id} ${one.text} ${one.system} ${one.charts.join(" ")}`)
      && (!findings || isFinding(one)) && (!here || one.system === at.system));
    const most = 150;
    const rows = found.slice(0, most).map(propertyRow);
    if (found.length > most) {
      rows.push(make("p", { class: "soft", text: `${found.length - most} more: write more into the filter.` }));
    }
    return rows.length ? rows : [make("p", { class: "soft", text: "There is no such property." })];
  };

  const pill = (word, text) => make("span", { class: `pill ${word}`, text });

  const propertyRow = (one) => {
    const verdicts = [pill(one.expected, `${one.expected} on record`)];
    if (one.decided) verdicts.push(" ", pill(one.decided, `${one.decided}, decided now`));
    const buttons = [make("button", {
      type: "button", text: one.decided ? "Decide again" : "Decide", title: "Search now, as rovercheck check does",
      onclick: () => decide(one.id),
    })];
    if (one.has_run) {
      buttons.push(make("button", { type: "button", text: "Explore its run", onclick: () => load(one.id) }));
      buttons.push(make("a", {
        class: "button", target: "_blank", href: `trace?property=${encodeURIComponent(one.id)}`, text: "Trace",
      }));
    }
    const parts = [make("b", { text: one.id }), " ", ...verdicts, make("small", { text: `${one.text} (${one.system})` })];
    if (one.evidence) parts.push(make("small", { text: one.evidence }));
    else if (one.because) parts.push(make("small", { text: `On record: ${one.because}` }));
    return make("div", { class: "property", "data-property": one.id }, ...parts, make("div", { class: "buttons" }, ...buttons));
  };

  // --- sessions ---

  const refresh = async () => {
    overview = await ask("overview");
    byId("model-name").textContent = overview.model.name
      + (overview.model.watched ? ", read again when it is saved" : "");
    problem(overview.model.problem);
    drawList();
    fill("open-sessions", overview.sessions.map((one) => make("p", {}, make("button", {
      type: "button", text: `Go on with ${one.system} at tick ${one.tick}`, onclick: () => resume(one.id),
    }))));
  };

  const problem = (text) => {
    byId("problem").textContent = text && `What was saved cannot be read; the model before it is still shown.\n${text}`;
    show("problem", Boolean(text));
  };

  const entered = async (told) => {
    picked = [];
    pictures = null;
    chosenChart = "";
    followed = "";
    await shown(told);
  };

  const open = (name) => act(async () => entered(await ask("open", { name })));
  const load = (property) => act(async () => entered(await ask("load", { property })));
  const resume = (session) => act(async () => entered(await ask("state", { session })));

  const shown = async (told) => {
    const before = at;
    const redraw = !pictures || !before || before.session !== told.session || before.version !== told.version;
    at = told;
    if (redraw) await drawPictures();
    if (!before || before.tick !== told.tick || redraw) picked = [];
    location.hash = told.session;
    document.body.classList.add("exploring");
    document.querySelector(".side").classList.remove("shown");
    show("welcome", false);
    show("session", true);
    byId("title").textContent = told.system;
    byId("where").textContent = `Tick ${told.tick} of ${told.ticks} executed · ${told.ms} ms`;
    byId("said").textContent = told.said.join("\n");
    show("said", told.said.length > 0);
    byId("first").disabled = byId("back").disabled = told.tick === 0;
    byId("forward").disabled = byId("last").disabled = told.tick === told.ticks;
    byId("save").disabled = told.tick === 0;
    byId("random").setAttribute("aria-pressed", String(told.inputs.some((one) => one.free)));
    drawSteps();
    drawFacts();
    mark();
    drawList();
  };

  // --- next steps ---

  const label = (transition) => transition.label;

  const drawSteps = () => {
    const next = at.next;
    const moving = next.steps.filter((step) => step.moves);
    const all = byId("all-steps").checked || !moving.length;
    const steps = all ? next.steps : moving;
    const notes = [...next.problems, ...next.bounded];
    if (!next.steps.length && !next.problems.length) {
      notes.push("Whatever the inputs are, the next tick takes the same transitions.");
    } else if (next.steps.length) {
      notes.push(`${next.steps.length} in all, found by a solver in ${next.ms} ms.`);
    }
    byId("next-note").textContent = notes.join(" ");
    show("all-label", moving.length > 0 && moving.length < next.steps.length);
    const several = new Set(next.steps.map((step) => step.of)).size > 1;
    const groups = new Map();
    for (const step of steps) groups.set(step.of, [...(groups.get(step.of) || []), step]);
    const rows = [];
    for (const [of, inside] of groups) {
      if (groups.size > 1 || several) rows.push(make("h4", { class: "group", text: of }));
      rows.push(...inside.map((step) => stepRow(step, several)));
    }
    if (!steps.length && next.anyway.length) {
      const lines = next.anyway.map((one) => make("b", { text: `${one.chart}: ${one.way}` }))
        .flatMap((line, i) => (i ? [make("br"), line] : [line]));
      rows.push(make("div", { class: "step" }, make("span"), make("button", {
        type: "button", title: "Execute the tick", onclick: () => move("step", { ticks: 1 }),
      }, ...lines)));
    }
    if (picked.length) rows.push(together());
    fill("steps", rows);
  };

  const stepRow = (step, several) => {
    const title = several ? step.title.slice(step.of.length + 2) : step.title;
    const lines = step.transitions.map(label).filter(Boolean).map((text) => make("small", { text }));
    const by = step.by.length ? `by ${step.by.join(", ")}` : "with the inputs as they stand";
    lines.push(make("small", { class: "by", text: by }));
    const also = step.also.map((one) => `${one.chart}: ${one.way}`).join("; ");
    if (also) lines.push(make("small", { text: `also ${also}` }));
    const button = make("button", {
      type: "button", title: "Take this step", "data-key": step.key,
      onclick: () => move("take", { keys: [step.key] }),
      onmouseenter: () => offer(step), onmouseleave: () => offer(null),
      onfocus: () => offer(step), onblur: () => offer(null),
    }, make("b", { text: title }), ...lines);
    const box = several ? make("input", {
      type: "checkbox", "aria-label": `${step.title}, together with others`, title: "Together with others",
      onchange: (event) => pick(step, event.target.checked),
    }) : make("span");
    if (several) box.checked = picked.some((one) => one.key === step.key);
    return make("div", { class: step.moves ? "step" : "step keeps" }, box, button);
  };

  const pick = (step, is) => act(async () => {
    const before = picked;
    picked = [...picked.filter((one) => one.of !== step.of), ...(is ? [step] : [])];
    try {
      const told = await ask("state", { session: at.session, required: picked.map((one) => one.key) });
      at = told;
    } catch (error) {
      picked = before;
      throw error;
    } finally {
      drawSteps();
    }
  });

  const together = () => make("div", { class: "together" },
    `Together: ${picked.map((one) => one.title).join("; ")}`,
    make("button", {
      type: "button", class: "main", text: "Take", onclick: () => move("take", { keys: picked.map((one) => one.key) }),
    }),
    make("button", { type: "button", text: "Clear", onclick: () => { picked = []; move("state"); } }));

  // --- charts ---

  const drawPictures = async () => {
    pictures = await ask("pictures", { session: at.session });
    figures = new Map();
    fill("charts", pictures.charts.map((chart) => {
      const figure = make("figure", { class: "chart", "data-chart": chart.name, tabindex: "0", "aria-label": `Chart ${chart.name}` });
      figure.innerHTML = chart.picture;  // drawn by the server; whatever came from a model is escaped in it
      figure.prepend(caption(chart.name));
      figures.set(chart.name, figure);
      return figure;
    }));
    if (!pictures.charts.length) fill("charts", [make("p", { class: "soft", text: "This system has no chart." })]);
    const legend = ["yellow: active states; red: transitions taken in this tick; blue: those of the step pointed at"];
    fill("legend", [...legend, ...pictures.legend].map((text) => make("li", { text })));
    const area = pictures.charts.reduce((sum, one) => sum + one.width * one.height, 0);
    chosenChart = area <= 700000 ? "*" : "";
    const button = (name, text) => make("button", {
      type: "button", "data-shown": name, text, onclick: () => { chosenChart = name; arrange(); },
    });
    const choices = pictures.charts.length > 1
      ? [button("", "Follow"), button("*", "All"), ...pictures.charts.map((one) => button(one.name, one.name))] : [];
    fill("choice", choices);
    const names = [...pictures.charts.flatMap((one) => [...figures.get(one.name).querySelectorAll("[data-state]")]
      .map((part) => `${one.name}.${part.dataset.state}`)), ...at.values.map((one) => one.name)];
    fill("names", names.map((value) => make("option", { value })));
  };

  // How many properties speak of a chart, and how many of them are violated.
  const caption = (name) => {
    const about = overview.properties.filter((one) => one.charts.includes(name));
    const found = about.filter(isFinding).length;
    const text = `${about.length} ${about.length === 1 ? "property speaks" : "properties speak"} of ${name}`
      + (found ? `, ${found} violated` : "");
    const list = () => {
      byId("filter").value = name;
      byId("only-findings").checked = found > 0;
      byId("tab-properties").click();
    };
    return make("figcaption", { "data-about": name }, about.length ? make("button", { type: "button", text, onclick: list }) : "");
  };

  const parts = (name, kind, value) => {
    const figure = figures.get(name);
    return figure ? [...figure.querySelectorAll(`[data-${kind}]`)].filter((part) => part.dataset[kind] === value) : [];
  };

  const mark = () => {
    for (const figure of figures.values()) {
      for (const part of figure.querySelectorAll(".active, .fired")) part.classList.remove("active", "fired");
    }
    for (const [name, states] of Object.entries(at.active)) {
      for (const state of states) parts(name, "state", state).forEach((part) => part.classList.add("active"));
    }
    for (const one of at.fired) {
      for (const drawn of one.drawn) parts(one.chart, "arrow", drawn).forEach((part) => part.classList.add("fired"));
    }
    const first = at.fired.find((one) => one.moves) || (followed ? null : at.fired[0]);
    const offered = at.next.steps.find((step) => step.moves);
    followed = (first && first.chart) || followed || (offered && offered.of) || [...figures.keys()][0] || "";
    arrange();
  };

  const arrange = () => {
    const moved = new Set(at.fired.filter((one) => one.moves).map((one) => one.chart));
    for (const button of byId("choice").children) {
      button.setAttribute("aria-pressed", String(button.dataset.shown === chosenChart));
      button.classList.toggle("moves-now", moved.has(button.dataset.shown));
    }
    for (const [name, figure] of figures) {
      figure.hidden = chosenChart !== "*" && name !== (chosenChart || followed);
      if (!figure.hidden) reveal(figure, ".fired");
    }
  };

  // Scroll inside a figure, and not the page, until what stands out is seen.
  const reveal = (figure, what) => {
    const marks = [...figure.querySelectorAll(what)].map((mark) => mark.getBoundingClientRect());
    if (!marks.length) return;
    const outer = figure.getBoundingClientRect();
    const [left, right] = [Math.min(...marks.map((m) => m.left)), Math.max(...marks.map((m) => m.right))];
    const [top, bottom] = [Math.min(...marks.map((m) => m.top)), Math.max(...marks.map((m) => m.bottom))];
    if (left < outer.left || right > outer.right) figure.scrollLeft += (left + right - outer.left - outer.right) / 2;
    if (top < outer.top || bottom > outer.bottom) figure.scrollTop += (top + bottom - outer.top - outer.bottom) / 2;
  };

  const offer = (step) => {
    for (const figure of figures.values()) {
      for (const part of figure.querySelectorAll(".offered")) part.classList.remove("offered");
    }
    if (!step) return;
    for (const one of step.transitions) {
      for (const drawn of one.drawn) parts(one.chart, "arrow", drawn).forEach((part) => part.classList.add("offered"));
    }
    if (chosenChart === "" && figures.has(step.of) && followed !== step.of) {
      followed = step.of;
      arrange();
    }
    const figure = figures.get(step.of);
    if (figure && !figure.hidden) reveal(figure, ".offered");
  };

  // --- values, timers, breaks, the past, properties ---

  const valueRow = (one, editable) => {
    const name = make("span", { text: one.name + (one.free ? " (random)" : ""), title: one.doc || one.domain });
    let value = make("span", { text: one.value });
    const changed = (event) => move("set", { name: one.name, value: event.target.value });
    if (editable && one.choices.length) {
      value = make("select", { "aria-label": one.name, onchange: changed },
        ...one.choices.map((text) => make("option", { text, value: text, selected: text === one.value })));
    } else if (editable) {
      value = make("input", { type: "text", value: one.value, "aria-label": one.name, title: one.domain, onchange: changed });
    }
    return make("div", { class: one.changed ? "value changed" : "value", "data-name": one.name }, name, value);
  };

  const drawFacts = () => {
    const none = () => [make("p", { class: "soft", text: "None." })];
    const some = (rows) => (rows.length ? rows : none());
    fill("inputs", some(at.inputs.map((one) => valueRow(one, true))));
    show("frozen-part", at.frozen.length > 0);
    fill("frozen", at.frozen.map((one) => valueRow(one, at.tick === 0)));
    fill("values", some(at.values.map((one) => valueRow(one, false))));
    show("timers-part", at.timers.length > 0);
    fill("timers", at.timers.map((one) => make("div", { class: "timer" },
      `${one.name}: ${one.value} of ${one.limit}`, make("progress", { max: 1, value: one.share, "aria-label": one.name }))));
    fill("breaks", at.breaks.map((text, number) => make("li", {}, `break: ${text} `,
      make("button", { type: "button", text: "Remove", onclick: () => move("unbreak", { number }) }))));
    const past = at.past.map((one) => make("li", { "aria-current": String(one.tick === at.tick) },
      make("button", { type: "button", onclick: () => move("goto", { tick: one.tick }) }, `${one.tick} · ${one.ms} ms  ${one.text}`)));
    if (at.past_left) past.unshift(make("li", { class: "soft", text: `${at.past_left} earlier ones are not listed; First and Back lead there.` }));
    fill("past", past.length ? past : none());
    const own = overview ? overview.properties.filter((one) => one.system === at.system) : [];
    fill("verdicts", some(own.map(propertyRow)));
  };

  // --- searches ---

  const follow = (told) => {
    job = told;
    drawJob();
    setTimeout(() => watchJob(told.job), 250);
  };

  const watchJob = async (id) => {
    if (!job || job.job !== id) return;
    try {
      const told = await ask("job", { job: id });
      if (!job || job.job !== id) return;
      job = told;
      drawJob();
      if (told.state === "searching") {
        setTimeout(() => watchJob(id), 500);
        return;
      }
      if (told.session && at && told.session.session === at.session) {
        await shown(told.session);
        drawJob();
        const wanted = [...figures.keys()].find((name) => told.about.includes(`${name}.`));
        if (wanted && told.state === "done") {
          followed = wanted;
          arrange();
        }
      }
      if (told.verdict) {
        overview.properties = overview.properties.map((one) => (one.id === told.verdict.id ? told.verdict : one));
        drawList();
        if (at) drawFacts();
        for (const [name, figure] of figures) figure.querySelector("figcaption").replaceWith(caption(name));
      }
    } catch (error) {
      failed(error);
      job = null;
      drawJob();
    }
  };

  const drawJob = () => {
    const told = job && job.state === "done" && at && at.said.includes(job.answer);
    show("job", job !== null && at !== null && !told);
    const floating = job !== null && at === null;
    byId("connection").textContent = floating ? jobText() : "";
    if (!job) return;
    byId("job-text").textContent = jobText();
    show("cancel", job.state === "searching");
    byId("job").classList.toggle("violated", job.state === "failed");
  };

  const jobText = () => {
    if (job.state === "searching") return `${job.about}: ${job.line || "searching"} (${Math.round(job.seconds)} s)`;
    return job.state === "cancelled" ? `${job.about}: cancelled` : job.answer;
  };

  const decide = (property) => act(async () => follow(await ask("decide", { property })));

  const condition = () => byId("condition").value.trim();

  // --- what people do ---

  const listen = () => {
    for (const name of ["systems", "properties"]) {
      const tab = byId(`tab-${name}`);
      tab.addEventListener("click", () => {
        listed = name;
        document.querySelector(".side").classList.add("shown");
        drawList();
      });
      tab.addEventListener("keydown", (event) => {
        if (event.key !== "ArrowLeft" && event.key !== "ArrowRight") return;
        const other = byId(name === "systems" ? "tab-properties" : "tab-systems");
        other.click();
        other.focus();
        event.stopPropagation();
      });
    }
    for (const id of ["filter", "only-findings", "only-here"]) byId(id).addEventListener("input", drawList);
    byId("all-steps").addEventListener("input", drawSteps);
    const goto = (tick) => () => move("goto", { tick: tick() });
    byId("first").addEventListener("click", goto(() => 0));
    byId("back").addEventListener("click", goto(() => Math.max(0, at.tick - 1)));
    byId("forward").addEventListener("click", goto(() => at.tick + 1));
    byId("last").addEventListener("click", goto(() => at.ticks));
    byId("step").addEventListener("click", () => move("step", { ticks: 1 }));
    byId("run").addEventListener("click", () => move("step", { ticks: 50 }));
    byId("random").addEventListener("click", () => move("random"));
    byId("save").addEventListener("click", save);
    byId("ask").addEventListener("submit", (event) => {
      event.preventDefault();
      move("reach", { condition: condition() });
    });
    byId("until").addEventListener("click", () => move("until", { condition: condition() }));
    byId("break").addEventListener("click", () => move("break", { condition: condition() }));
    byId("cancel").addEventListener("click", () => act(async () => { await ask("cancel", { job: job.job }); }));
    document.addEventListener("keydown", keyed);
  };

  const KEYS = { ArrowLeft: "back", ArrowRight: "forward", Home: "first", End: "last", s: "step", r: "run" };

  const keyed = (event) => {
    const inside = event.target.closest("input, select, textarea, [role=tab]");
    if (!at || inside || event.ctrlKey || event.metaKey || event.altKey || !KEYS[event.key]) return;
    const button = byId(KEYS[event.key]);
    event.preventDefault();
    if (!button.disabled) button.click();
  };

  // The run is also saved where the server has ended: it was told with the last step.
  const save = () => {
    const address = URL.createObjectURL(new Blob([at.script], { type: "text/plain" }));
    const link = make("a", { href: address, download: `${at.system}-run.txt` });
    link.click();
    setTimeout(() => URL.revokeObjectURL(address), 1000);
  };

  const news = () => {
    const source = new EventSource("news");
    let version = overview.model.version;
    source.onopen = () => lost(false);
    source.onerror = () => lost(true);
    source.onmessage = async (event) => {
      const told = JSON.parse(event.data);
      problem(told.problem);
      if (told.version === version) return;
      version = told.version;
      try {
        await refresh();
        if (at) await shown(await ask("state", { session: at.session }));
      } catch (error) {
        failed(error);
      }
    };
  };

  act(async () => {
    listen();
    await refresh();
    news();
    const session = location.hash.slice(1);
    if (overview.sessions.some((one) => one.id === session)) await entered(await ask("state", { session }));
  });
})();
