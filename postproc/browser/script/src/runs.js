// The runs of a sweep: a table that sorts, their curves, any figure over any key, parallel coordinates. What the pointer
// is on is the same run in all of them.
import { chart_section } from "./chart.js";
import { choice, ends_of, is_number, title_of } from "./columns.js";
import { element, quoted, save, shown, svg } from "./elements.js";
import { parallel_section } from "./parallel.js";

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
