"use strict";
// What is zoomed by two fingers, or by the wheel with Ctrl, instead of the whole page.
const zoomable = (element, zoom) => {
  let apart = 0;
  const between = ([a, b]) => Math.hypot(a.clientX - b.clientX, a.clientY - b.clientY);
  element.addEventListener("wheel", (event) => {
    if (!event.ctrlKey && !event.metaKey) return;
    event.preventDefault();
    zoom(Math.exp(-event.deltaY / 300), event.clientX, event.clientY);
  }, { passive: false });
  element.addEventListener("touchstart", (event) => {
    apart = event.touches.length === 2 ? between(event.touches) : 0;
    if (apart) event.preventDefault();
  }, { passive: false });
  element.addEventListener("touchmove", (event) => {
    if (!apart || event.touches.length !== 2) return;
    event.preventDefault();
    const [a, b] = event.touches, now = between(event.touches);
    zoom(now / apart, (a.clientX + b.clientX) / 2, (a.clientY + b.clientY) / 2);
    apart = now;
  }, { passive: false });
  const ended = () => { apart = 0; };
  element.addEventListener("touchend", ended);
  element.addEventListener("touchcancel", ended);
};
