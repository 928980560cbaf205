// Series of a chart: how uPlot draws them, and their key, which points one out and hides others.
import uPlot from "uplot";
import { element, is_dark, svg } from "./elements.js";
import { series_colours } from "./colours.js";

/** What a reader does to the series of a chart: hidden ones, and the one that is pointed out (-1: none). */
export const seen_series = () => ({ hidden: new Set(), pointed: -1 });

const steps_of_dash = [8, 5];
const few_points = 400; // more hide the line that they are on
const faint = 0.15;

function colour_of_series(series) {
  const list = series_colours[is_dark() ? "dark" : "light"];
  return list[(series.colour ?? 0) % list.length];
}

/** A band between y and upper. */
function fill_band(ctx, series, x, y, xs) {
  ctx.globalAlpha *= 0.25;
  for (let i = 0; i < xs.length; ++i) ctx.lineTo(x(i), y(i));
  for (let i = xs.length - 1; i >= 0; --i) ctx.lineTo(x(i), y(i, series.upper));
  ctx.fill();
}

function stroke_line(ctx, x, y, n, is_drawn) {
  let pen = false;
  for (let i = 0; i < n; ++i) {
    if (!is_drawn(i)) pen = false;
    else {
      if (pen) ctx.lineTo(x(i), y(i));
      else ctx.moveTo(x(i), y(i));
      pen = true;
    }
  }
  ctx.stroke();
}

/** Discs on lines; rings, where points alone are data, through which a line is seen. */
function draw_points(ctx, x, y, n, is_drawn, are_rings) {
  const r = (n < 100 ? 3 : 2) * uPlot.pxRatio;
  ctx.beginPath();
  for (let i = 0; i < n; ++i)
    if (is_drawn(i)) {
      ctx.moveTo(x(i) + r, y(i));
      ctx.arc(x(i), y(i), r, 0, 2 * Math.PI);
    }
  if (!are_rings) return ctx.fill();
  ctx.lineWidth = 1.2 * uPlot.pxRatio;
  ctx.stroke();
}

/** Draws series `s` of a chart as uPlot's `paths`; `seen` as of seen_series(). */
export function draw_series(series, s, seen) {
  return (u, index) => {
    uPlot.orient(u, index, (_, xs, ys, scale_x, scale_y, to_x, to_y, left, top, wide, high) => {
      if (seen.hidden.has(s)) return;
      const { ctx } = u;
      const x = (i) => to_x(xs[i], scale_x, wide, left);
      const y = (i, values = ys) => to_y(values[i], scale_y, high, top);
      const is_drawn = (i) =>
        ys[i] !== null && xs[i] !== null && (scale_x.distr !== 3 || xs[i] > 0) && (scale_y.distr !== 3 || ys[i] > 0);
      ctx.save();
      ctx.beginPath();
      ctx.rect(left, top, wide, high);
      ctx.clip();
      ctx.globalAlpha = seen.pointed >= 0 && seen.pointed !== s ? faint : 1;
      ctx.strokeStyle = ctx.fillStyle = colour_of_series(series);
      ctx.lineWidth = 2 * uPlot.pxRatio;
      ctx.beginPath();
      if (series.style === "band") fill_band(ctx, series, x, y, xs);
      else {
        const are_alone = series.style === "points";
        if (series.style === "dashed") ctx.setLineDash(steps_of_dash.map((d) => d * uPlot.pxRatio));
        if (!are_alone) stroke_line(ctx, x, y, xs.length, is_drawn);
        if (are_alone || (series.style === "line_with_points" && xs.length < few_points))
          draw_points(ctx, x, y, xs.length, is_drawn, are_alone);
      }
      ctx.restore();
    });
    return null;
  };
}

/** The sign of a series in the key. */
function mark_of(series) {
  const is_ring = series.style === "points";
  const sign = is_ring
    ? svg("circle", { cx: 13, cy: 6, r: 4, fill: "none", "stroke-width": 1.5 })
    : svg("line", { x1: 0, x2: 26, y1: 6, y2: 6, "stroke-width": series.style === "band" ? 10 : 3 });
  if (series.style === "dashed") sign.setAttribute("stroke-dasharray", "7 4");
  if (series.style === "band") sign.setAttribute("stroke-opacity", 0.3);
  const mark = svg("svg", { width: 26, height: 12 }, sign);
  mark.paint = () => sign.setAttribute("stroke", colour_of_series(series));
  mark.paint();
  return mark;
}

/**
 * The key of a chart, null without labels. Of several series each is a button: pointed at, it makes the others faint; a
 * click hides it and shows it again. `changed` is called when `seen` has changed.
 */
export function key_of(chart, seen, changed) {
  const labelled = [...chart.series.keys()].filter((s) => chart.series[s].label);
  if (labelled.length === 0) return null;
  const point = (s) => () => {
    seen.pointed = s;
    changed();
  };
  const entry = (s) => {
    const series = chart.series[s];
    if (chart.series.length === 1) return element("span", {}, mark_of(series), series.label);
    const toggle = () => {
      if (!seen.hidden.delete(s)) seen.hidden.add(s);
      made.setAttribute("aria-pressed", !seen.hidden.has(s));
      changed();
    };
    const made = element(
      "button",
      {
        "aria-pressed": "true",
        title: "A click hides it, and shows it again",
        onclick: toggle,
        onpointerenter: point(s),
        onpointerleave: point(-1),
        onfocus: point(s),
        onblur: point(-1),
      },
      mark_of(series),
      series.label,
    );
    return made;
  };
  return element("div", { class: "key" }, ...labelled.map(entry));
}
