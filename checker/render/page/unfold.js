"use strict";
(() => {
  /** A long list of actions in a chart is shown whole by a click, and hidden by the next one. */
  const toggle = (event) => {
    const asked = event.target.closest(".statechart [data-actions]");
    if (!asked) return false;
    const same = (one) => one.dataset.actions === asked.dataset.actions;
    const all = [...asked.closest("svg").querySelectorAll("[data-actions]")].filter(same);
    const whole = all.find((one) => one.matches(".all-actions")), open = whole.classList.toggle("open");
    all.find((one) => one.matches(".folded")).setAttribute("aria-expanded", String(open));
    return true;
  };
  document.addEventListener("click", toggle);
  document.addEventListener("keydown", (event) => {
    if ((event.key === "Enter" || event.key === " ") && event.target.closest(".folded") && toggle(event)) event.preventDefault();
  });
})();
