// The runs of a sweep in parallel coordinates.
import { choice, ends_of, is_number, title_of } from "./columns.js";
import { colour_maps } from "./colours.js";
import { element, shown, svg } from "./elements.js";

/** viridis by the place of a value between the ends; grey for none. */
function colour_of_value(value, [from, to]) {
  if (!is_number(value)) return "#8a8a8a";
  const k = 3 * Math.round(235 * ((value - from) / (to - from))); // its last yellow is too light on white
  const table = colour_maps.viridis;
  return `rgb(${table[k]},${table[k + 1]},${table[k + 2]})`;
}

/** A line for each run across an axis for each column. */
export function parallel_section(data, columns, figures, pointer) {
  const [step, high, top, bottom] = [118, 300, 44, 24];
  const wide = step * columns.length;
  const ends = columns.map((column) => ends_of(column.values));
  const left = (k) => step * (k + 0.5);
  const place = (k, value) => top + (high - top - bottom) * (1 - (value - ends[k][0]) / (ends[k][1] - ends[k][0]));
  let by = figures[0] ?? columns[columns.length - 1];
  const lines = data.labels.map((label, run) => {
    let d = "";
    let pen = "M";
    columns.forEach((column, k) => {
      if (!is_number(column.values[run])) return void (pen = "M");
      d += `${pen}${left(k)} ${place(k, column.values[run]).toFixed(1)}`;
      pen = "L";
    });
    return pointer.watch(svg("path", { d, class: "run" }, svg("title", {}, label)), run);
  });
  const paint = () => {
    const range = ends_of(by.values);
    lines.forEach((line, run) => line.setAttribute("stroke", colour_of_value(by.values[run], range)));
  };
  paint();
  const axes = columns.map((column, k) => {
    const text = (y, words, size) => svg("text", { x: left(k), y, "text-anchor": "middle", "font-size": size }, words);
    const words = column.words.length > 20 ? `\u2026${column.words.slice(-19)}` : column.words;
    return svg(
      "g",
      { class: "axis" },
      svg("title", {}, title_of(column)),
      svg("line", { x1: left(k), x2: left(k), y1: top, y2: high - bottom }),
      text(14, words, 11.5),
      text(29, column.unit ? `[${column.unit}]` : "", 11.5),
      text(top - 3, shown(ends[k][1]), 11.5),
      text(high - bottom + 14, shown(ends[k][0]), 11.5),
    );
  });
  const drawn = svg("svg", { viewBox: `0 0 ${wide} ${high}`, role: "img", "aria-label": "parallel coordinates" });
  drawn.append(...lines, ...axes);
  drawn.style.minWidth = `${wide}px`;
  drawn.style.maxHeight = "480px";
  const select = choice(columns, by, (column) => ((by = column), paint()));
  return element(
    "section",
    { class: "parallel" },
    element(
      "div",
      { class: "head" },
      element("h2", {}, "All columns, a line for each run"),
      element("div", { class: "controls" }, element("label", {}, "colours by", select)),
    ),
    element("div", { class: "scrolls" }, drawn),
  );
}
