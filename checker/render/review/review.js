'use strict';
(() => {
  const all = (what, within = document) => [...within.querySelectorAll(what)];
  const one = (what) => document.querySelector(what);
  document.documentElement.classList.add('js');

  // --- going to a place: what holds it is opened, what hides it is shown

  function show(element) {
    if (element.closest('.hide')) clear();
    for (let at = element; at; at = at.parentElement) if (at.tagName === 'DETAILS') at.open = true;
    element.scrollIntoView();
  }
  function arrive() {
    const id = decodeURIComponent(location.hash.slice(1));
    const element = id && document.getElementById(id);
    if (element) show(element);
  }
  addEventListener('hashchange', arrive);
  document.addEventListener('click', (event) => {
    const link = event.target.closest('a[href^="#"]');
    if (link && link.hash === location.hash) arrive();
  });

  // --- search and filters

  const field = one('.search input');
  const verdict = one('.f-verdict'), area = one('.f-area'), system = one('.f-system');
  const reset = one('.reset'), hits = one('.hits');
  const entries = all('.entry');
  let texts = null;
  function words() {
    texts = texts || entries.map((entry) => `${entry.id} ${entry.textContent}`.toLowerCase());
    return field.value.toLowerCase().split(/\s+/).filter(Boolean);
  }
  function chosen(entry) {
    const has = entry.dataset;
    return (!verdict.value || (has.verdict || '').split(' ').includes(verdict.value))
      && (!area.value || has.area === area.value)
      && (!system.value || has.system === system.value);
  }
  function apply() {
    const wanted = words();
    const filtered = Boolean(wanted.length || verdict.value || area.value || system.value);
    let count = 0;
    entries.forEach((entry, i) => {
      const hit = chosen(entry) && wanted.every((word) => texts[i].includes(word));
      entry.classList.toggle('hide', !hit);
      count += hit;
    });
    for (const stub of all('.stub, .decisions')) stub.classList.toggle('hide', filtered);
    for (const part of all('.cause, .group, main > section')) {
      const kept = part.querySelector('.entry:not(.hide)');
      part.classList.toggle('hide', filtered && !kept);
    }
    for (const group of all('.area')) {
      const kept = filtered && group.querySelector('.entry:not(.hide)');
      if (kept && !group.open) group.dataset.auto = '';
      if (kept || 'auto' in group.dataset) group.open = Boolean(kept);
      if (!filtered) delete group.dataset.auto;
    }
    reset.hidden = !filtered;
    hits.textContent = filtered ? `${count} of ${entries.length} entries` : '';
    if (filtered) scrollTo(0, 0);
  }
  function clear() {
    field.value = verdict.value = area.value = system.value = '';
    apply();
  }
  let waiting = 0;
  field.addEventListener('input', () => {
    clearTimeout(waiting);
    waiting = setTimeout(apply, 120);
  });
  for (const choice of [verdict, area, system]) choice.addEventListener('change', apply);
  reset.addEventListener('click', clear);
  one('.search').addEventListener('submit', (event) => {
    event.preventDefault();
    clearTimeout(waiting);
    apply();
    const exact = entries.find((entry) => entry.id.toLowerCase() === field.value.trim().toLowerCase());
    const first = exact || one('.entry:not(.hide)');
    if (!first) return;
    show(first);
    const focus = first.querySelector('summary');
    if (focus) focus.focus({ preventScroll: true });
  });
  document.addEventListener('keydown', (event) => {
    const typing = /^(INPUT|SELECT|TEXTAREA)$/.test(event.target.tagName);
    if (event.key === '/' && !typing && !event.defaultPrevented && !event.ctrlKey && !event.metaKey && !event.altKey) {
      event.preventDefault();
      field.focus();
    }
    if (event.key === 'Escape' && event.target === field) clear();
  });
  for (const button of all('.open-all')) {
    button.addEventListener('click', () => {
      const opened = button.textContent === 'Open all';
      for (const entry of all('details.entry:not(.hide)', button.closest('section'))) entry.open = opened;
      button.textContent = opened ? 'Close all' : 'Open all';
    });
  }

  // --- proofs and pictures of traces, unpacked when their entry is opened

  let printed = [];
  let parcels = null;
  const opened = new Map();
  async function unpacked(name) {
    parcels = parcels || JSON.parse(one('script.packed').textContent);
    const parcel = parcels.find((p) => p.names.includes(name));
    if (!opened.has(parcel)) opened.set(parcel, inflated(parcel.parts));
    const place = parcel.names.indexOf(name);
    return (await opened.get(parcel)).map((column) => column[place]).join('');
  }
  async function inflated(text) {
    const bytes = Uint8Array.from(atob(text), (c) => c.charCodeAt(0));
    const stream = new Blob([bytes]).stream().pipeThrough(new DecompressionStream('deflate-raw'));
    return JSON.parse(await new Response(stream).text());
  }
  async function fill(place) {
    place.dataset.begun = '';
    place.innerHTML = await unpacked(place.dataset.late);
    place.dispatchEvent(new Event('page:added', { bubbles: true }));
  }
  let gallery = null;
  async function unpack(places) {
    for (const place of places) {
      if (!place.matches('.body, .picture')) {
        gallery = gallery || (one('.gallery') ? fill(one('.gallery')) : true);
        await gallery;
      }
      await fill(place);
      begin(place);
    }
  }
  function begin(within) {
    const places = all('.late:not([data-begun])', within);
    for (const place of places) place.dataset.begun = '';
    if (places.length) unpack(places).catch(() => places.forEach(missing));
  }
  function missing(place) {
    if (!place.hasChildNodes()) place.textContent = 'This browser cannot unpack what is kept here.';
  }
  document.addEventListener('toggle', (event) => {
    const entry = event.target;
    if (!entry.open || printed.length || !entry.classList.contains('entry')) return;
    begin(entry);
  }, true);

  // --- print: findings open without their moving pictures, afterwards as before

  addEventListener('beforeprint', () => {
    printed = all('details.finding:not([open]), details.means:not([open]), details.area:not([open])');
    for (const entry of printed) entry.open = true;
  });
  addEventListener('afterprint', () => {
    for (const entry of printed) entry.open = false;
    printed = [];
  });

  arrive();
})();
