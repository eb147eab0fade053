"use strict";
// A picture in a frame: it fits when the page opens, and is zoomed within the frame.
const fittedPicture = (frame) => {
  const picture = frame.querySelector("svg");
  if (!picture) return { zoom: () => {}, fit: () => {} };
  const wide = picture.viewBox.baseVal.width;
  let scale = 1;
  const fits = () => Math.min(1, (frame.clientWidth - 2) / wide);
  const shown = () => {
    picture.style.maxWidth = scale === 1 ? "100%" : "none";
    picture.style.width = `${Math.floor(wide * fits() * scale)}px`;
    picture.style.height = "auto";
  };
  const zoom = (factor, x, y) => {
    const box = frame.getBoundingClientRect();
    const at = [x === undefined ? frame.clientWidth / 2 : x - box.left, y === undefined ? frame.clientHeight / 2 : y - box.top];
    const before = scale;
    scale = Math.min(8, Math.max(1, scale * factor));
    shown();
    frame.scrollLeft = (frame.scrollLeft + at[0]) * scale / before - at[0];
    frame.scrollTop = (frame.scrollTop + at[1]) * scale / before - at[1];
  };
  const fit = () => { scale = 1; shown(); };
  zoomable(frame, zoom);
  fit();
  return { zoom, fit };
};
