// The body: what is shown of it, and how.
import { Cells, surface_of } from "./cells.js";
import { colour_maps } from "./colours.js";
import { controls_of, listen } from "./controls.js";
import { integers, octets, quantised } from "./bytes.js";
import { colour_of, element, save, shown } from "./elements.js";
import { quantities_of } from "./quantities.js";
import { Scene } from "./scene.js";
import { Vibration } from "./vibration.js";
import { first_view } from "./view.js";

const broken = 0.95;

/** The numbers of the page's data, unpacked. */
async function unpacked(body) {
  const [shape, region, open] = await Promise.all([
    octets(body.shape),
    octets(body.region),
    body.open ? octets(body.open) : null,
  ]);
  const [corners, stream, parents] = await Promise.all([
    integers(body.corners),
    integers(body.stream),
    integers(body.base),
  ]);
  const n = body.n_points;
  const places = await Promise.all(body.points.map((axis) => quantised(axis, 1, n)));
  const n_moves = body.vibrates ? 2 : body.frames.length;
  const moves = await Promise.all(body.displacement.map((axis) => quantised(axis, n_moves, n)));
  const fields = await Promise.all(
    body.fields.map((field) => quantised(field.values, body.frames.length, shape.length)),
  );
  const cells = new Cells({ shape, corners, stream, region, base: parents, open });
  return { cells, places: places.map(([block]) => block), moves, fields };
}

/** A number 1, 2 or 5 times a power of ten, not above the given one. */
function round_down(value) {
  const power = 10 ** Math.floor(Math.log10(value));
  return [5, 2, 1].find((k) => k * power <= value * (1 + 1e-9)) * power;
}

export class Body {
  constructor(data, steps, on_frame, title = "The body") {
    this.data = data;
    this.steps = steps;
    this.on_frame = on_frame;
    this.frame = data.frames.length - 1;
    this.holder = element("div", {
      class: "scene",
      tabindex: "0",
      "aria-label": "The body. Arrows: steps; space: play; h, j, k, l: turn; plus and minus: zoom",
    });
    this.note = element("div", { class: "note" });
    this.read = element("div", { class: "read" });
    this.state = element("p", { class: "state", "aria-live": "polite" });
    this.section = element("section", { class: "body" }, element("h2", {}, title), this.holder);
  }

  async start() {
    await this.load();
    const { steps, state, scale, choices } = this.show();
    this.section.append(steps, state, scale, ...choices);
  }

  async load() {
    Object.assign(this, await unpacked(this.data));
    if (this.data.vibrates) this.vibration = new Vibration(this);
    this.prepare();
  }

  /** Draws what was loaded; returns its controls. */
  show() {
    this.scene = new Scene(this.holder);
    this.holder.append(this.note, this.read);
    const controls = controls_of(this);
    this.repaint();
    this.home();
    listen(this);
    return controls;
  }

  prepare() {
    const { data } = this;
    this.lower = data.points.map((axis) => axis.from);
    this.upper = data.points.map((axis) => axis.to);
    this.size = this.upper.map((v, i) => v - this.lower[i]);
    this.length = Math.hypot(...this.size);
    let most = 0;
    for (let f = 0; f < (data.vibrates ? 1 : data.frames.length); ++f)
      for (let i = 0; i < data.n_points; ++i)
        most = Math.max(most, Math.hypot(...this.moves.map((axis) => axis[f][i])));
    this.most_moved = most;
    this.warp = most < 1e-12 * this.length || most > 0.02 * this.length ? 1 : round_down((0.08 * this.length) / most);
    this.is_flat = this.data.flat_axis >= 0;
    this.cut = { axis: this.is_flat || data.cuts === "none" ? -1 : data.cut_axis, at: 0, flipped: false };
    this.set_cut_axis(this.cut.axis);
    this.regions = data.regions.map(() => true);
    this.hide_broken = true;
    this.mesh_lines = false;
    this.quantities = quantities_of(data, this.moves, this.fields, most);
    const has_damage =
      this.quantities[0].name === "damage" && this.fields[0].some((block) => block.some((v) => v > 0.05));
    this.quantity = this.quantities[this.quantities[0].name === "damage" && !has_damage ? 1 : 0];
    this.damage = this.quantities[0].name === "damage" ? this.fields[0] : null;
  }

  set_cut_axis(axis) {
    this.cut.axis = axis;
    if (axis >= 0) this.cut.at = this.data.cut_at[axis];
    this.cut.flipped = false;
  }

  /** Distance from the cut of each corner, negative where the body is kept. */
  sides() {
    const { axis, at, flipped } = this.cut;
    if (axis < 0) return null;
    // The nearer side to the first look is taken away: low y, high x, high z.
    const sign = (axis === 1 ? -1 : 1) * (flipped ? -1 : 1);
    const shift = 1e-6 * this.length; // off faces that lie in the plane
    const place = this.places[axis];
    const side = new Float32Array(place.length);
    for (let i = 0; i < side.length; ++i) side[i] = sign * (place[i] - at) + shift * 0.5;
    return side;
  }

  draw() {
    const { cells, frame } = this;
    const shown_cells = new Uint8Array(cells.n);
    for (let i = 0; i < cells.n; ++i)
      shown_cells[i] =
        this.regions[cells.region[i]] && !(this.damage && this.hide_broken && this.damage[frame][i] > broken) ? 1 : 0;
    this.soup = surface_of(cells, shown_cells, this.sides());
    const { a, b, t } = this.soup;
    const points = new Float32Array(3 * a.length);
    for (let c = 0; c < 3; ++c) {
      const now = this.warped(c);
      for (let i = 0; i < a.length; ++i) points[3 * i + c] = now(a[i], b[i], t[i]);
    }
    const of_ends = (ends) => {
      const found = new Float32Array(3 * ends.length);
      for (let c = 0; c < 3; ++c) {
        const now = this.warped(c);
        ends.forEach((v, i) => (found[3 * i + c] = now(v[0], v[1], v[2])));
      }
      return found;
    };
    this.scene.show({
      points,
      colours: this.colours(),
      lines: of_ends(this.mesh_lines ? this.soup.lines : []),
      borders: of_ends(this.soup.borders),
    });
    this.tell();
    for (const other of this.followers ?? []) other.follow(this);
  }

  /** Shows what another body shows, as far as this one has it. */
  follow(lead) {
    const same = this.quantities.find((quantity) => quantity.name === lead.quantity.name);
    if (same) {
      this.quantity = same;
      same.map = lead.quantity.map;
    }
    for (const choice of ["warp", "hide_broken", "mesh_lines"]) this[choice] = lead[choice];
    const { axis, at, flipped } = lead.cut;
    const part = axis < 0 ? 0 : (at - lead.lower[axis]) / (lead.size[axis] || 1);
    if (!this.is_flat && this.data.cuts !== "none")
      this.cut = { axis, at: axis < 0 ? 0 : this.lower[axis] + part * this.size[axis], flipped };
    this.data.regions.forEach((name, r) => {
      const theirs = lead.data.regions.indexOf(name);
      if (theirs >= 0) this.regions[r] = lead.regions[theirs];
    });
    this.draw();
  }

  /** A coordinate of a vertex, moved. */
  warped(c) {
    const place = this.places[c];
    const move = this.moves[c][this.frame];
    const { warp } = this;
    return (a, b, t) => (1 - t) * (place[a] + warp * move[a]) + t * (place[b] + warp * move[b]);
  }

  value_at(vertex) {
    const q = this.quantity;
    const { a, b, t, cell } = this.soup;
    if (q.at_cells) return q.factor * q.at_cells[this.frame][cell[Math.floor(vertex / 3)]];
    return (
      q.factor * ((1 - t[vertex]) * q.at_points(this.frame, a[vertex]) + t[vertex] * q.at_points(this.frame, b[vertex]))
    );
  }

  colours() {
    const table = colour_maps[this.quantity.map];
    const [from, to] = this.quantity.range;
    const n = this.soup.a.length;
    const colours = new Uint8Array(3 * n);
    for (let i = 0; i < n; ++i) {
      const k = 3 * Math.round(255 * Math.min(1, Math.max(0, (this.value_at(i) - from) / (to - from))));
      colours[3 * i] = table[k];
      colours[3 * i + 1] = table[k + 1];
      colours[3 * i + 2] = table[k + 2];
    }
    return colours;
  }

  tell() {
    const q = this.quantity;
    this.note.textContent = `${q.name}${q.unit ? ` [${q.unit}]` : ""}${this.warp === 1 ? ", true to scale" : `, displacement times ${shown(this.warp)}`}`;
    this.state.textContent = this.steps[this.data.frames[this.frame]] ?? "";
    const table = colour_maps[q.map];
    const stops = [];
    for (let i = 0; i <= 16; ++i) {
      const k = 3 * Math.round((i / 16) * 255);
      stops.push(`rgb(${table[k]},${table[k + 1]},${table[k + 2]})`);
    }
    const middle = (q.range[0] + q.range[1]) / 2;
    this.scale.replaceChildren(
      shown(q.range[0]),
      element("div", {
        class: "strip",
        style: `background: linear-gradient(to right, ${stops.join(",")}); print-color-adjust: exact`,
      }),
      shown(q.range[1]),
      ` ${q.unit}`,
      element("span", { class: "faint" }, `(middle ${shown(middle)})`),
    );
    this.slider.value = this.frame;
    this.slider.setAttribute("aria-valuetext", this.state.textContent);
  }

  go(frame, told = true) {
    this.frame = Math.min(this.data.frames.length - 1, Math.max(0, frame));
    this.draw();
    if (told) this.on_frame(this.data.frames[this.frame]);
  }

  first() {
    this.go(0);
  }

  last() {
    this.go(this.data.frames.length - 1);
  }

  /** To the frame that is nearest to a row of the run's curve. */
  go_to_row(row) {
    let best = 0;
    this.data.frames.forEach((r, f) => {
      if (Math.abs(r - row) < Math.abs(this.data.frames[best] - row)) best = f;
    });
    this.stop();
    this.go(best);
  }

  play() {
    if (this.data.frames.length === 1) return this.vibration?.play();
    if (this.timer) return this.stop();
    this.play_button.textContent = "\u25a0 Stop";
    if (this.frame === this.data.frames.length - 1) this.go(0);
    this.timer = setInterval(() => {
      if (this.frame >= this.data.frames.length - 1) return this.stop();
      this.go(this.frame + 1);
    }, 220);
  }

  stop() {
    clearInterval(this.timer);
    this.timer = null;
    this.play_button.textContent = "\u25b6 Play";
  }

  /** Looks at the cut, or at a plate from above. */
  home() {
    const { middle, direction, up, seen } = first_view(this, this.holder.getBoundingClientRect());
    this.scene.look(middle, direction, up, 4 * this.length, seen);
    this.draw();
  }

  repaint() {
    this.scene?.paint(colour_of("--scene"), colour_of("--ink"), colour_of("--faint"));
  }

  save_picture() {
    this.scene.picture().toBlob((blob) => save("body.png", blob, "image/png"));
  }
}
