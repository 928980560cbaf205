// The controls of the body, its keys, and what the pointer reads.
import { colour_maps } from "./colours.js";
import { element, shown } from "./elements.js";

/** Sliders, choices and boxes that change what is shown of a body. */
export function controls_of(body) {
  const { data } = body;
  const last = data.frames.length - 1;
  body.slider = element("input", {
    type: "range",
    min: 0,
    max: last,
    value: last,
    "aria-label": "step",
    oninput: () => body.go(Number(body.slider.value)),
  });
  body.play_button = element("button", { onclick: () => body.play(), "aria-label": "play or stop" }, "\u25b6 Play");
  const choice = (names, chosen, act) => {
    const select = element(
      "select",
      { onchange: () => act(select.selectedIndex) },
      ...names.map((name, i) => element("option", { selected: i === chosen }, name)),
    );
    return select;
  };
  const label = (text, ...what) => element("label", {}, text, ...what);
  const check = (text, on, act) => {
    const box = element("input", { type: "checkbox", checked: on, onchange: () => (act(box.checked), body.draw()) });
    return label("", box, text);
  };
  const quantity = choice(
    body.quantities.map((q) => q.name),
    body.quantities.indexOf(body.quantity),
    (i) => {
      body.quantity = body.quantities[i];
      body.map_choice.value = body.quantity.map;
      body.draw();
    },
  );
  body.map_choice = choice(
    Object.keys(colour_maps),
    0,
    (i) => ((body.quantity.map = Object.keys(colour_maps)[i]), body.draw()),
  );
  body.map_choice.value = body.quantity.map;
  const warp = element("input", {
    type: "number",
    min: 0,
    step: "any",
    value: body.warp,
    style: "width: 6em",
    oninput: () => {
      const value = Number(warp.value);
      if (!Number.isFinite(value)) return;
      body.warp = value;
      body.draw();
    },
  });
  const steps = element(
    "div",
    {},
    element("div", { class: "steps", hidden: last === 0 }, body.play_button, body.slider),
    body.vibration?.controls(),
  );
  body.scale = element("div", { class: "scale" });
  const choices = [
    element(
      "div",
      { class: "controls" },
      label("colour", quantity),
      label("map", body.map_choice),
      label("warp (1 is true)", warp),
      body.damage ? check("leave broken cells out", true, (on) => (body.hide_broken = on)) : null,
      check("mesh", false, (on) => (body.mesh_lines = on)),
      element("button", { onclick: () => body.home() }, "Front"),
      element("button", { onclick: () => body.save_picture() }, "Picture"),
    ),
  ];
  if (!body.is_flat && data.cuts !== "none") choices.push(cut_controls(body, choice, label));
  if (data.regions.length > 1)
    choices.push(
      element(
        "div",
        { class: "controls" },
        "regions:",
        ...data.regions.map((name, r) => check(name, true, (on) => (body.regions[r] = on))),
      ),
    );
  return { steps, state: body.state, scale: body.scale, choices };
}

function cut_controls(body, choice, label) {
  const unit = body.data.length_unit;
  const at = element("input", { type: "range", min: 0, max: 1000, "aria-label": "place of the cut" });
  const place = element("span", {});
  const fixed = body.data.cuts === "fixed";
  const tell = () => {
    const { axis } = body.cut;
    at.disabled = axis < 0 || fixed;
    place.textContent = axis < 0 ? "" : `${"xyz"[axis]} = ${shown(body.cut.at * unit.factor)} ${unit.name}`;
    if (axis >= 0) at.value = Math.round((1000 * (body.cut.at - body.lower[axis])) / (body.size[axis] || 1));
  };
  at.addEventListener("input", () => {
    const { axis } = body.cut;
    body.cut.at = body.lower[axis] + (Number(at.value) / 1000) * body.size[axis];
    tell();
    body.draw();
  });
  const across = choice(
    ["no cut", "across x", "across y", "across z"],
    body.cut.axis + 1,
    (i) => (body.set_cut_axis(i - 1), tell(), body.draw()),
  );
  const flip = element(
    "button",
    { onclick: () => ((body.cut.flipped = !body.cut.flipped), body.draw()) },
    "Other side",
  );
  tell();
  return element("div", { class: "controls" }, label("cut", across), label("", at), place, flip);
}

/** Keys in the picture, and the value under the pointer. */
export function listen(body) {
  const acts = {
    ArrowLeft: () => body.go(body.frame - 1),
    ArrowRight: () => body.go(body.frame + 1),
    Home: () => body.first(),
    End: () => body.last(),
    " ": () => body.play(),
    h: () => body.scene.turn(10, 0),
    l: () => body.scene.turn(-10, 0),
    j: () => body.scene.turn(0, -10),
    k: () => body.scene.turn(0, 10),
    "+": () => body.scene.zoom(1.2),
    "-": () => body.scene.zoom(1 / 1.2),
  };
  body.holder.addEventListener(
    "keydown",
    (e) => {
      if (!acts[e.key] || e.ctrlKey || e.metaKey || e.altKey) return;
      acts[e.key]();
      e.preventDefault();
      e.stopPropagation();
    },
    { capture: true },
  );
  body.holder.addEventListener("pointermove", (e) => {
    if (e.buttons) return;
    const home = body.holder.getBoundingClientRect();
    const found = body.scene.pick(e.clientX - home.left, e.clientY - home.top);
    body.read.textContent =
      found < 0
        ? ""
        : `${body.data.regions[body.cells.region[body.soup.cell[found]]] ?? ""}: ${shown(body.value_at(3 * found))} ${body.quantity.unit}`;
  });
  body.holder.addEventListener("pointerleave", () => (body.read.textContent = ""));
}
