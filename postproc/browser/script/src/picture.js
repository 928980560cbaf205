// Flat pictures: polygons coloured by a value, and lines.
import { colour_maps } from "./colours.js";
import { colour_of, element, on_size, shown } from "./elements.js";

const table = colour_maps.viridis;

function bounds_of(picture) {
  const box = [Infinity, Infinity, -Infinity, -Infinity];
  const see = (x, y) => {
    box[0] = Math.min(box[0], x);
    box[1] = Math.min(box[1], y);
    box[2] = Math.max(box[2], x);
    box[3] = Math.max(box[3], y);
  };
  for (const cell of picture.cells) for (let k = 1; k < cell.length; k += 2) see(cell[k], cell[k + 1]);
  for (const line of picture.lines) for (let k = 0; k < line.length; k += 2) see(line[k], line[k + 1]);
  return box[0] <= box[2] ? box : [0, 0, 1, 1];
}

/** A cell is its value and its corners, two opposite ones of a rectangle. */
export function picture_section(picture) {
  const canvas = element("canvas", { role: "img", "aria-label": picture.caption });
  const box = bounds_of(picture);
  const wide = box[2] - box[0] || 1;
  const high = box[3] - box[1] || 1;
  let drawn = 0;
  const draw = (anew = true) => {
    const width = canvas.clientWidth;
    if (!width || (!anew && width === drawn)) return;
    drawn = width;
    const height = picture.stretched ? Math.round(0.55 * width) : Math.round(Math.min(600, (width * high) / wide));
    const ratio = window.devicePixelRatio || 1;
    canvas.style.height = `${height}px`;
    canvas.width = width * ratio;
    canvas.height = height * ratio;
    const ctx = canvas.getContext("2d");
    const scale = picture.stretched ? null : Math.min(canvas.width / wide, canvas.height / high);
    const left = scale ? (canvas.width - scale * wide) / 2 : 0;
    const x = (v) => left + (v - box[0]) * (scale ?? canvas.width / wide);
    const y = (v) => canvas.height - (v - box[1]) * (scale ?? canvas.height / high);
    const trace = (points, from) => {
      ctx.beginPath();
      for (let k = from; k < points.length; k += 2) ctx.lineTo(x(points[k]), y(points[k + 1]));
    };
    for (const cell of picture.cells) {
      const part = Math.min(1, Math.max(0, (cell[0] - picture.least) / (picture.most - picture.least || 1)));
      const k = 3 * Math.round(255 * part);
      ctx.fillStyle = ctx.strokeStyle = `rgb(${table[k]},${table[k + 1]},${table[k + 2]})`;
      if (cell.length === 5) {
        const [, left_x, low_y, right_x, high_y] = cell;
        const [x0, x1] = [x(left_x), x(right_x)].sort((a, b) => a - b);
        const [y0, y1] = [y(low_y), y(high_y)].sort((a, b) => a - b);
        ctx.fillRect(Math.floor(x0), Math.floor(y0), Math.ceil(x1) - Math.floor(x0), Math.ceil(y1) - Math.floor(y0));
        continue;
      }
      trace(cell, 1);
      ctx.closePath();
      ctx.fill();
      ctx.stroke();
    }
    ctx.strokeStyle = colour_of("--ink");
    ctx.lineWidth = ratio;
    for (const line of picture.lines) {
      trace(line, 0);
      ctx.stroke();
    }
  };
  const stops = [0, 4, 8, 12, 16].map((i) => {
    const k = 3 * Math.round((i / 16) * 255);
    return `rgb(${table[k]},${table[k + 1]},${table[k + 2]})`;
  });
  const unit = (v) => shown(v);
  const section = element(
    "section",
    { class: "picture" },
    element("h2", {}, picture.caption),
    canvas,
    element(
      "div",
      { class: "scale" },
      unit(picture.least),
      element("div", {
        class: "strip",
        style: `background: linear-gradient(to right, ${stops.join(",")}); print-color-adjust: exact`,
      }),
      unit(picture.most),
      ` ${picture.value_title}`,
    ),
    element(
      "p",
      { class: "faint" },
      `${picture.x_title}: ${unit(box[0])} to ${unit(box[2])}; ${picture.y_title}: ${unit(box[1])} to ${unit(box[3])}`,
    ),
  );
  on_size(section, () => draw(false));
  section.repaint = () => draw();
  return section;
}
