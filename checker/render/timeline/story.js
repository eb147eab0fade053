"use strict";
(() => {
  /** Rows that repeat those above them are shown by a click, and hidden by the next. */
  document.addEventListener("click", (event) => {
    const button = event.target.closest(".told-more");
    if (!button) return;
    const inside = button.closest("tbody").nextElementSibling;
    inside.hidden = !inside.hidden;
    button.setAttribute("aria-expanded", String(!inside.hidden));
    button.textContent = inside.hidden ? "Show them" : "Hide them";
  });
})();
