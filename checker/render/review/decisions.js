'use strict';
(() => {
  const all = (what, within = document) => [...within.querySelectorAll(what)];
  const one = (what, within = document) => within.querySelector(what);
  const block = one('script.decisions-kept');
  if (!block) return;
  const STATES = { accepted: 'to be accepted', repair: 'to be repaired', reject: 'rejected: no fault' };
  const page = JSON.parse(block.textContent);
  const place = `rovercheck-review-${page.page}`;
  const rows = new Map(all('tr[data-finding]').map((row) => [row.dataset.finding, row]));
  const status = one('.d-status'), reviewer = one('.d-reviewer'), total = one('.decided-here');
  let stored = true;

  // --- what is decided: as the file says, or as this browser has kept it since that file was saved

  function kept() {
    try {
      const found = JSON.parse(localStorage.getItem(place));
      return found && found.saved === page.saved ? found : page;
    } catch {
      return page;
    }
  }
  const state = (({ decisions, reviewer: name }) => ({ decisions: { ...decisions }, reviewer: name }))(kept());
  for (const id of Object.keys(state.decisions)) if (!rows.has(id)) delete state.decisions[id];

  function keep() {
    try {
      localStorage.setItem(place, JSON.stringify({ saved: page.saved, ...state }));
      stored = true;
    } catch {
      stored = false;
    }
    tell();
  }
  addEventListener('beforeunload', (event) => {
    if (!stored) event.preventDefault();
  });

  // --- what is said of it

  const fault = (of) => {
    if (of.decision !== 'accepted') return '';
    if (!of.because.trim()) return 'Write why it is accepted: without a reason it cannot be exported.';
    const today = new Date();
    const iso = [today.getFullYear(), today.getMonth() + 1, today.getDate()].map((n) => String(n).padStart(2, '0'));
    return of.until && of.until < iso.join('-') ? 'That day is over; choose a later one, or none.' : '';
  };
  function tell() {
    for (const [id, row] of rows) {
      const cell = one('.d-state', row), of = state.decisions[id];
      cell.textContent = of ? STATES[of.decision] : cell.dataset.state;
      cell.classList.toggle('decided', Boolean(of));
    }
    for (const cell of all('dd[data-decision]')) {
      const of = state.decisions[cell.dataset.decision];
      cell.dataset.given ??= cell.textContent;
      cell.textContent = of ? `${STATES[of.decision]}, on this page` : cell.dataset.given;
    }
    const count = Object.keys(state.decisions).length;
    total.textContent = count ? `; ${count} decided on this page` : '';
    const given = one('.reviewer');
    given.textContent = state.reviewer || given.dataset.given || 'not named';
    if (!stored) status.textContent = 'This browser keeps nothing of this page: save it before you close it.';
  }

  // --- forms, made where a finding is opened

  const form = one('template.d-form');
  function fill(where) {
    const id = where.dataset.decide;
    where.append(form.content.cloneNode(true));
    const choices = all('input[type=radio]', where);
    const because = one('.d-because', where), owner = one('.d-owner', where), until = one('.d-until', where);
    function show() {
      const of = state.decisions[id];
      for (const choice of choices) choice.checked = Boolean(of) && choice.value === of.decision;
      [because.value, owner.value, until.value] = of ? [of.because, of.owner, of.until] : ['', '', ''];
      one('.d-fault', where).textContent = of ? fault(of) : '';
    }
    function take() {
      const chosen = choices.find((choice) => choice.checked);
      if (chosen) {
        const words = [because, owner, until].map((field) => field.value);
        state.decisions[id] = { decision: chosen.value, because: words[0], owner: words[1], until: words[2] };
      }
      one('.d-fault', where).textContent = chosen ? fault(state.decisions[id]) : 'Choose what is decided.';
      keep();
    }
    for (const choice of choices) choice.name = `decide ${id}`;
    one('form', where).addEventListener('input', take);
    one('form', where).addEventListener('submit', (event) => event.preventDefault());
    one('.d-clear', where).addEventListener('click', () => {
      delete state.decisions[id];
      keep();
      show();
    });
    show();
  }
  document.addEventListener('toggle', (event) => {
    if (!event.target.open || !event.target.matches('details.finding')) return;
    const where = one('.decide-here:not([data-begun])', event.target);
    if (!where) return;
    where.dataset.begun = '';
    fill(where);
  }, true);
  reviewer.value = state.reviewer;
  reviewer.addEventListener('input', () => {
    state.reviewer = reviewer.value;
    keep();
  });

  // --- files: this page with its decisions, and acceptances for rovercheck accept --from

  function download(text, kind, name) {
    const link = document.createElement('a');
    link.href = URL.createObjectURL(new Blob([text], { type: kind }));
    link.download = name;
    document.body.append(link);
    link.click();
    link.remove();
    setTimeout(() => URL.revokeObjectURL(link.href), 60000);
  }
  const json = (value) => JSON.stringify(value).replaceAll('<', '\\u003c');
  function asMade() {
    const copy = document.documentElement.cloneNode(true);
    copy.classList.remove('js');
    for (const made of all('[data-begun]', copy)) {
      made.replaceChildren();
      made.removeAttribute('data-begun');
    }
    for (const button of all('th > button', copy)) button.replaceWith(...button.childNodes);
    for (const entry of all('details[open]', copy)) entry.open = false;
    for (const hidden of all('.hide, .row-hidden', copy)) hidden.classList.remove('hide', 'row-hidden');
    const end = one('body', copy).lastChild;
    if (end.nodeType === Node.TEXT_NODE) end.remove();
    return copy;
  }
  one('.d-save').addEventListener('click', () => {
    const copy = asMade();
    one('script.decisions-kept', copy).textContent = json({ ...page, saved: new Date().toISOString(), ...state });
    download(`<!doctype html>\n${copy.outerHTML}\n`, 'text/html', 'review.html');
    const count = Object.keys(state.decisions).length;
    status.textContent = `Saved as review.html, with ${count} ${count === 1 ? 'decision' : 'decisions'}.`;
  });
  one('.d-export').addEventListener('click', () => {
    const records = [], faulty = [];
    for (const [id, of] of Object.entries(state.decisions)) {
      const before = one('.d-state', rows.get(id)).dataset.state;
      if (fault(of)) faulty.push(`${id} (${fault(of)})`);
      else if (of.decision === 'accepted') {
        const more = Object.entries({ owner: of.owner.trim(), until: of.until }).filter(([, text]) => text);
        records.push({ id, decision: 'accepted', because: of.because.trim(), ...Object.fromEntries(more) });
      } else if (before === 'accepted' || before === 'expired') {
        records.push({ id, decision: 'open', because: of.because.trim() });
      }
    }
    const left = Object.keys(state.decisions).length - records.length - faulty.length;
    const words = [];
    if (faulty.length) words.push(`Left out: ${faulty.join(' ')}`);
    if (left) words.push(`${left} to be repaired or rejected: no acceptance to write.`);
    if (records.length) {
      const document = { schema: 'rovercheck/decisions/1', decisions: records };
      download(`${JSON.stringify(document, null, 2)}\n`, 'application/json', 'decisions.json');
      words.unshift(`${records.length} in decisions.json.`);
    } else words.unshift('Nothing to export: no finding is accepted here.');
    if (!state.reviewer.trim()) words.push('No reviewer is named.');
    status.textContent = words.join(' ');
  });

  tell();
})();
