// The runs of a sweep: a table that sorts, their curves, any figure over any key, parallel coordinates. What the pointer
// is on is the same run in all of them.
import { chart_section } from "./chart.js";
import { colour_maps } from "./colours.js";
import { element, save, shown } from "./elements.js";

const svg = (tag, attributes = {}, ...children) => {
  const made = document.createElementNS("http://www.w3.org/2000/svg", tag);
  for (const [name, value] of Object.entries(attributes)) made.setAttribute(name, value);
  made.append(...children);
  return made;
};

const title_of = (column) => (column.unit ? `${column.words} [${column.unit}]` : column.words);
const is_number = (v) => v !== null && Number.isFinite(v);

/** Least and most of what is a number; a little apart where there is one value alone. */
function ends_of(values) {
  const numbers = values.filter(is_number);
  if (numbers.length === 0) return [0, 1];
  const [least, most] = [Math.min(...numbers), Math.max(...numbers)];
  return least < most ? [least, most] : [least - (Math.abs(least) || 1), most + (Math.abs(most) || 1)];
}

/** Also where some runs have no value. */
const varies = (column) => new Set(column.values.map((value) => (is_number(value) ? value : null))).size > 1;

/** Which run is pointed out; who shows runs is told. */
class Pointer {
  constructor() {
    this.listeners = [];
    this.run = -1;
  }
  at(run) {
    if (run === this.run) return;
    this.run = run;
    for (const listener of this.listeners) listener(run);
  }
  /** An element that stands for a run. */
  watch(made, run) {
    made.addEventListener("pointerenter", () => this.at(run));
    made.addEventListener("pointerleave", () => this.at(-1));
    this.listeners.push((now) => made.classList.toggle("pointed", now === run));
    return made;
  }
}

/** viridis by the place of a value between the ends; grey for none. */
function colour_of_value(value, [from, to]) {
  if (!is_number(value)) return "#8a8a8a";
  const k = 3 * Math.round(235 * ((value - from) / (to - from))); // its last yellow is too light on white
  const table = colour_maps.viridis;
  return `rgb(${table[k]},${table[k + 1]},${table[k + 2]})`;
}

function table_section(data, pointer) {
  const order = data.labels.map((_, run) => run);
  const body = element("tbody");
  const columns = data.columns.filter((column) => column.is_key || varies(column));
  const alike = data.columns.filter((column) => !columns.includes(column) && is_number(column.values[0]));
  const rows = order.map((run) =>
    pointer.watch(
      element(
        "tr",
        {},
        element("td", {}, data.labels[run]),
        ...columns.map((column) => element("td", { class: "number" }, shown(column.values[run] ?? NaN))),
        data.notes.some(Boolean) ? element("td", {}, data.notes[run] ?? "") : null,
      ),
      run,
    ),
  );
  let by = null;
  let falling = false;
  const heads = [];
  const sort = (column) => {
    falling = column === by ? !falling : false;
    by = column;
    const value = (run) => (column < 0 ? run : columns[column].values[run]);
    order.sort((a, b) => {
      const [x, y] = [value(a), value(b)];
      if (!is_number(x) || !is_number(y)) return Number(is_number(y)) - Number(is_number(x)); // none are last
      return (falling ? y - x : x - y) || a - b;
    });
    body.append(...order.map((run) => rows[run]));
    heads.forEach((head, k) => {
      const sorted = k - 1 === by;
      head.setAttribute("aria-sort", sorted ? (falling ? "descending" : "ascending") : "none");
    });
  };
  const head = (text, column) => {
    const made = element("th", {}, element("button", { onclick: () => sort(column), title: "Sort by it" }, text));
    heads.push(made);
    return made;
  };
  const quoted = (text) => (/[",\n]/.test(text) ? `"${text.replaceAll('"', '""')}"` : text);
  const csv = () =>
    [
      ["run", ...data.columns.map(title_of)],
      ...order.map((run) => [data.labels[run], ...data.columns.map((column) => column.values[run] ?? "")]),
    ]
      .map((cells) => cells.map((cell) => quoted(String(cell))).join(","))
      .join("\n") + "\n";
  const names = element(
    "tr",
    {},
    head("run", -1),
    ...columns.map((column, k) => head(title_of(column), k)),
    data.notes.some(Boolean) ? element("th", {}, "") : null,
  );
  sort(-1);
  return element(
    "section",
    { class: "runs" },
    element(
      "div",
      { class: "head" },
      element("h2", {}, `Runs (${data.labels.length})`),
      element("div", {}, element("button", { onclick: () => save("runs.csv", csv(), "text/csv") }, "CSV")),
    ),
    element("div", { class: "scrolls tall" }, element("table", {}, element("thead", {}, names), body)),
    alike.length === 0
      ? null
      : element(
          "p",
          { class: "faint" },
          `The same in all runs: ${alike.map((column) => `${column.words} ${shown(column.values[0])} ${column.unit}`.trim()).join(", ")}.`,
        ),
  );
}

/** All curves faintly, one of them drawn: a small picture for each run. */
function curves_section(data, pointer) {
  const [wide, high] = [170, 110];
  const x_ends = ends_of(data.curves.flatMap((curve) => curve?.x ?? []));
  const y_ends = ends_of(data.curves.flatMap((curve) => curve?.y ?? []));
  const path = (curve) => {
    let pen = "M";
    let text = "";
    curve.x.forEach((x, i) => {
      if (!is_number(x) || !is_number(curve.y[i])) return void (pen = "M");
      const left = 3 + ((wide - 6) * (x - x_ends[0])) / (x_ends[1] - x_ends[0]);
      const top = high - 3 - ((high - 6) * (curve.y[i] - y_ends[0])) / (y_ends[1] - y_ends[0]);
      text += `${pen}${left.toFixed(1)} ${top.toFixed(1)}`;
      pen = "L";
    });
    return text;
  };
  const paths = data.curves.map((curve) => (curve ? path(curve) : ""));
  const all = paths.join("");
  const pictures = paths.map((own, run) =>
    pointer.watch(
      element(
        "figure",
        { title: data.labels[run] },
        svg(
          "svg",
          { viewBox: `0 0 ${wide} ${high}`, role: "img", "aria-label": `curve of ${data.labels[run]}` },
          svg("path", { d: all, class: "others" }),
          svg("path", { d: own, class: "own" }),
        ),
        element("figcaption", {}, own ? data.labels[run] : `${data.labels[run]}: no curve`),
      ),
      run,
    ),
  );
  return element(
    "section",
    {},
    element("h2", {}, `Curves: ${data.curve.y} over ${data.curve.x}`),
    element(
      "p",
      { class: "faint" },
      `Each of the runs before all others; ${data.curve.x}: ${shown(x_ends[0])} to ${shown(x_ends[1])}, ${data.curve.y}: ${shown(y_ends[0])} to ${shown(y_ends[1])}`,
    ),
    element("div", { class: "small" }, ...pictures),
  );
}

function choice(columns, chosen, act) {
  const select = element(
    "select",
    { onchange: () => act(columns[select.selectedIndex]) },
    ...columns.map((column) => element("option", { selected: column === chosen }, column.words)),
  );
  return select;
}

/** Any figure over any column, in colours of a third. Repaints by making the chart anew. */
function scatter_section(data, figures, keys) {
  let x = keys[0] ?? figures[0];
  let y = figures.find((column) => column !== x) ?? figures[0];
  let by = keys.length > 1 ? keys[1] : null;
  const holder = element("div");
  const draw = () => {
    const runs = data.labels.map((_, run) => run).filter((run) => is_number(x.values[run]) && is_number(y.values[run]));
    const groups = new Map([["", runs]]);
    if (by) {
      groups.clear();
      const values = [...new Set(runs.map((run) => by.values[run]))].sort((a, b) => a - b);
      for (const value of values)
        groups.set(
          `${by.words} ${shown(value ?? NaN)} ${by.unit}`,
          runs.filter((run) => by.values[run] === value),
        );
      if (values.length > 8) groups.clear(), groups.set("", runs);
    }
    const chart = {
      caption: `${y.words} over ${x.words}`,
      x: { title: title_of(x), logarithmic: false, room: true },
      y: { title: title_of(y), logarithmic: false },
      series: [...groups].map(([label, of], k) => ({
        label,
        style: "points",
        colour: k,
        x: of.map((run) => x.values[run]),
        y: of.map((run) => y.values[run]),
      })),
    };
    const made = chart_section(chart);
    holder.replaceChildren(made);
    section.repaint = made.repaint;
  };
  const columns = [...keys, ...figures];
  const none = { words: "nothing" };
  const section = element(
    "section",
    { class: "scatter" },
    element("h2", {}, "Any figure over any other"),
    element(
      "div",
      { class: "controls" },
      element("label", {}, "up", choice(columns, y, (column) => ((y = column), draw()))),
      element("label", {}, "across", choice(columns, x, (column) => ((x = column), draw()))),
      element(
        "label",
        {},
        "colours by",
        choice([none, ...columns], by ?? none, (column) => ((by = column === none ? null : column), draw())),
      ),
    ),
    holder,
  );
  draw();
  return section;
}

/** A line for each run across an axis for each column. */
function parallel_section(data, columns, figures, pointer) {
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

/** `data`: labels, notes, columns (words, unit, is_key, values), curve (titles x, y) and curves, or null. */
export function runs_sections(data) {
  const pointer = new Pointer();
  const keys = data.columns.filter((column) => column.is_key && varies(column));
  const figures = data.columns.filter((column) => !column.is_key && varies(column));
  const sections = [table_section(data, pointer)];
  if (data.curve) sections.push(curves_section(data, pointer));
  if (figures.length > 0 && keys.length + figures.length > 1) sections.push(scatter_section(data, figures, keys));
  const most = 10;
  const columns = [...keys, ...figures].slice(0, most);
  if (columns.length > 1) sections.push(parallel_section(data, columns, figures, pointer));
  return sections;
}
