// Charts of any curves, also such that run back and forth, drawn by uPlot: zoom by dragging, values under the pointer.
import uPlot from "uplot";
import { colour_of, element, file_name, on_size, quoted, save, shown } from "./elements.js";
import { draw_series, key_of, seen_series } from "./series.js";

const height_of = (width) => Math.round(Math.min(460, Math.max(240, 0.6 * width)));

/** Least and most of all series; of a logarithmic axis, of what is positive. */
function extent_of(chart, axis) {
  let least = Infinity;
  let most = -Infinity;
  const see = (values) => {
    for (const v of values ?? [])
      if (v !== null && (!chart[axis].logarithmic || v > 0)) {
        if (v < least) least = v;
        if (v > most) most = v;
      }
  };
  for (const series of chart.series) {
    see(series[axis]);
    if (axis === "y") see(series.upper);
  }
  if (!(least <= most)) [least, most] = [0, 1];
  const given = chart[axis];
  if (given.logarithmic) {
    [least, most] = [10 ** Math.floor(Math.log10(least)), 10 ** Math.ceil(Math.log10(most))];
    if (least === most) most = 10 * least;
  } else {
    const room = 0.04 * (most - least || Math.abs(most) || 1);
    if (axis === "y" || chart[axis].room) [least, most] = [least - room, most + room];
    else if (least === most) [least, most] = [least - room, most + room];
  }
  return [given.from ?? least, given.to ?? most];
}

/** Of a logarithmic axis: powers of ten, and their multiples where there are few. */
function log_ticks(u, axis, least, most) {
  const digits = Math.log10(most / least) > 6 ? [1] : [1, 2, 3, 4, 5, 6, 7, 8, 9];
  const ticks = [];
  for (let power = Math.floor(Math.log10(least)); power <= Math.ceil(Math.log10(most)); ++power)
    for (const digit of digits) ticks.push(Number(`${digit}e${power}`));
  return ticks.filter((v) => v >= least && v <= most);
}

/** Of these: powers of ten, of many each so many that they have room, and 2 and 5 times these where there are few. */
const with_label = (name) => (u, ticks) => {
  const { min, max } = u.scales[name];
  const decades = Math.log10(max / min);
  const stride = Math.max(1, Math.ceil(decades / (name === "x" ? 7 : 10)));
  return ticks.map((v) => {
    const power = Math.floor(Math.log10(v) + 1e-9);
    const lead = Math.round(v / 10 ** power);
    if (lead === 1) return power % stride === 0 ? v : null;
    return decades < 2.5 && (lead === 2 || lead === 5) ? v : null;
  });
};

/** As many digits as tell a tick from the next. */
function tick_words(value, step) {
  const digits = Math.ceil(Math.log10(Math.abs(value) / step)) + 1;
  const plain = Math.abs(value) >= 1e-3 && Math.abs(value) < 1e6;
  return digits > 4 && digits < 15 && plain ? String(Number(value.toPrecision(digits))) : shown(value);
}

function options_of(chart, width, seen, hooks) {
  const scale = (axis) => ({
    time: false,
    distr: chart[axis].logarithmic ? 3 : 1,
    auto: false,
    range: (u, from, to) => [from, to],
  });
  const axis = (name) => ({
    label: chart[name].title,
    stroke: () => colour_of("--ink"),
    grid: { stroke: () => colour_of("--line"), width: 1 },
    ticks: { stroke: () => colour_of("--line"), width: 1 },
    font: '13px "Liberation Sans", Helvetica, Arial, sans-serif',
    labelFont: '14px "Liberation Sans", Helvetica, Arial, sans-serif',
    size: name === "y" ? 64 : 44,
    ...(chart[name].logarithmic ? { splits: log_ticks, filter: with_label(name) } : {}),
    values: (u, ticks, _, space, step) => ticks.map((v) => (v === null ? "" : tick_words(v, step))),
  });
  return {
    mode: 2,
    width,
    height: height_of(width),
    legend: { show: false },
    scales: { x: scale("x"), y: scale("y") },
    axes: [axis("x"), axis("y")],
    cursor: { drag: { x: true, y: true, uni: 20 }, points: { show: false }, dataIdx: () => null },
    series: [
      {},
      ...chart.series.map((series, s) => ({
        label: series.label,
        facets: [
          { scale: "x", auto: false },
          { scale: "y", auto: false },
        ],
        paths: draw_series(series, s, seen),
      })),
    ],
    hooks,
  };
}

/** The point that is nearest to the pointer, within reach. */
function nearest(u, chart, seen, reach = 40) {
  const { left, top } = u.cursor;
  let found = null;
  let best = reach * reach;
  chart.series.forEach((series, s) => {
    if (series.style === "band" || seen.hidden.has(s)) return;
    for (let i = 0; i < series.x.length; ++i) {
      if (series.x[i] === null || series.y[i] === null) continue;
      const dx = u.valToPos(series.x[i], "x") - left;
      const dy = u.valToPos(series.y[i], "y") - top;
      const d = dx * dx + dy * dy;
      if (d < best) {
        best = d;
        found = { s, i, left: left + dx, top: top + dy };
      }
    }
  });
  return found;
}

/** Columns side by side, two or three for each series. */
export function csv_of(chart) {
  const columns = chart.series.flatMap((series) => {
    const name = series.label ? `${series.label}: ` : "";
    const found = [
      [name + chart.x.title, series.x],
      [name + chart.y.title, series.y],
    ];
    if (series.upper?.length) found.push([`${name}${chart.y.title}, upper edge`, series.upper]);
    return found;
  });
  const rows = [columns.map(([title]) => quoted(title)).join(",")];
  const n = Math.max(0, ...columns.map(([, values]) => values.length));
  for (let i = 0; i < n; ++i) rows.push(columns.map(([, values]) => values[i] ?? "").join(","));
  return `${rows.join("\n")}\n`;
}

/**
 * A chart as a section. `link`, if any, has row() and go(row): series with "of_steps" have a point for each row of the
 * run's curve; a mark is at the current one, and a click goes to the nearest.
 */
export function chart_section(chart, link) {
  const holder = element("div", {
    class: "chart",
    tabindex: "0",
    role: "img",
    "aria-label": `${chart.caption}: ${chart.y.title} over ${chart.x.title}`,
  });
  const tip = element("div", { class: "tip", hidden: true });
  const seen = seen_series();
  const redraw = () => plot?.redraw(false, false);
  const key = key_of(chart, seen, redraw);
  const linked = link ? chart.series.findIndex((series) => series.of_steps) : -1;
  let plot = null;
  const whole = () => {
    for (const axis of ["x", "y"]) {
      const [min, max] = extent_of(chart, axis);
      plot.setScale(axis, { min, max });
    }
  };
  const mark = (u) => {
    if (linked < 0) return;
    const i = link.row();
    const series = chart.series[linked];
    if (series.x[i] === undefined || series.x[i] === null) return;
    const { ctx } = u;
    const r = uPlot.pxRatio;
    const x = u.valToPos(series.x[i], "x", true);
    const y = u.valToPos(series.y[i], "y", true);
    ctx.save();
    ctx.beginPath();
    ctx.arc(x, y, 8 * r, 0, 2 * Math.PI);
    ctx.fillStyle = colour_of("--sheet");
    ctx.strokeStyle = colour_of("--ink");
    ctx.lineWidth = 3 * r;
    ctx.fill();
    ctx.stroke();
    ctx.restore();
  };
  const point_out = (u) => {
    const at = u.cursor.left < 0 ? null : nearest(u, chart, seen);
    tip.hidden = at === null;
    if (!at) return;
    const series = chart.series[at.s];
    const label = series.label ? `${series.label}: ` : "";
    tip.textContent = `${label}${shown(series.x[at.i])}, ${shown(series.y[at.i])}`;
    const over = u.over.getBoundingClientRect();
    const home = holder.getBoundingClientRect();
    const right = at.left > over.width / 2;
    tip.style.left = `${over.left - home.left + at.left + (right ? -12 : 12)}px`;
    tip.style.top = `${over.top - home.top + at.top - 30}px`;
    tip.style.transform = right ? "translateX(-100%)" : "";
  };
  const build = () => {
    const width = Math.max(200, holder.clientWidth);
    plot?.destroy();
    const data = [null, ...chart.series.map((series) => [series.x, series.y])];
    plot = new uPlot(options_of(chart, width, seen, { draw: [mark], setCursor: [point_out] }), data, holder);
    whole();
    plot.over.addEventListener("dblclick", whole);
    let down = null;
    plot.over.addEventListener("mousedown", (e) => (down = [e.clientX, e.clientY]));
    plot.over.addEventListener("mouseup", (e) => {
      if (linked < 0 || !down || Math.hypot(e.clientX - down[0], e.clientY - down[1]) > 4) return;
      let best = Infinity;
      let row = 0;
      const series = chart.series[linked];
      for (let i = 0; i < series.x.length; ++i) {
        const d = Math.hypot(
          plot.valToPos(series.x[i], "x") - plot.cursor.left,
          plot.valToPos(series.y[i], "y") - plot.cursor.top,
        );
        if (d < best) [best, row] = [d, i];
      }
      link.go(row);
    });
  };
  const section = element(
    "section",
    {},
    element(
      "div",
      { class: "head" },
      element("h2", {}, chart.caption),
      element(
        "div",
        {},
        element(
          "button",
          { onclick: () => plot && whole(), title: "Show all again (double click does it too)" },
          "Whole",
        ),
        " ",
        element("button", { onclick: () => save(`${file_name(chart.caption)}.csv`, csv_of(chart), "text/csv") }, "CSV"),
      ),
    ),
    key,
    holder,
  );
  holder.append(tip);
  holder.addEventListener("keydown", (e) => {
    if (linked < 0 || (e.key !== "ArrowLeft" && e.key !== "ArrowRight")) return;
    link.move(e.key === "ArrowLeft" ? -1 : 1);
    e.preventDefault();
  });
  on_size(holder, () => {
    if (!plot) return build();
    const width = Math.max(200, holder.clientWidth);
    if (Math.abs(width - plot.width) > 1) plot.setSize({ width, height: height_of(width) });
  });
  section.repaint = () => {
    for (const svg of section.querySelectorAll(".key svg")) svg.paint();
    redraw();
  };
  section.redraw = redraw;
  return section;
}
