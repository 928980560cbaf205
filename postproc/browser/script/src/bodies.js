// Bodies of several runs side by side, in step: one slider over what moves them, one set of controls.
import { Body } from "./body.js";
import { diverging } from "./colours.js";
import { element, shown } from "./elements.js";

/** The same colours mean the same values in all bodies. */
function share_ranges(bodies) {
  for (const name of new Set(bodies.flatMap((body) => body.quantities.map((q) => q.name)))) {
    const same = bodies.flatMap((body) => body.quantities.filter((q) => q.name === name));
    const reach = (q) => Math.max(...q.range.map(Math.abs)) / q.factor;
    const widest = same.reduce((a, b) => (reach(b) > reach(a) ? b : a));
    const { factor, unit } = widest;
    const ends = same.flatMap((q) => q.range.map((v) => (v / q.factor) * factor));
    const signed = same.some((q) => q.map === diverging);
    const most = Math.max(...ends.map(Math.abs));
    const range = signed ? [-most, most] : [Math.min(...ends), Math.max(...ends)];
    for (const q of same) Object.assign(q, { factor, unit, range: [...range], map: signed ? diverging : widest.map });
  }
}

/** As large as one another where they are nearly so. */
function share_scale(bodies) {
  const most = Math.max(...bodies.map((body) => body.scene.home.half));
  for (const { scene } of bodies)
    if (scene.home.half > most / 1.5) {
      scene.zoom(scene.home.half / most);
      scene.home.half = most;
    }
}

/** The frame whose value is nearest. */
function nearest_frame(of, value) {
  let best = 0;
  of.at.forEach((v, f) => {
    if (Math.abs(v - value) < Math.abs(of.at[best] - value)) best = f;
  });
  return best;
}

/**
 * `runs`: name, body, steps (words of each row of the run's curve) and `at`, a value of each frame of the body. `axis`:
 * what these values are, with their unit.
 */
export function bodies_section(runs, axis) {
  const ticks = [...new Set(runs.flatMap((run) => run.at))].sort((a, b) => a - b);
  const bodies = runs.map((run) => new Body(run.body, run.steps, () => {}, run.name));
  const slider = element("input", { type: "range", min: 0, max: ticks.length - 1, value: ticks.length - 1 });
  slider.setAttribute("aria-label", axis.words);
  const value = element("span", { class: "state" });
  const tell = () => {
    value.textContent = `${axis.words} ${shown(ticks[slider.value])} ${axis.unit}`;
    slider.setAttribute("aria-valuetext", value.textContent);
  };
  let timer = null;
  const go = (tick) => {
    slider.value = Math.min(ticks.length - 1, Math.max(0, tick));
    bodies.forEach((body, k) => (body.frame = nearest_frame(runs[k], ticks[slider.value])));
    bodies[0].draw(); // the others follow
    tell();
  };
  const stop = () => {
    clearInterval(timer);
    timer = null;
    play.textContent = "\u25b6 Play";
  };
  const play = element("button", { "aria-label": "play or stop" }, "\u25b6 Play");
  play.addEventListener("click", () => {
    if (timer) return stop();
    play.textContent = "\u25a0 Stop";
    if (Number(slider.value) === ticks.length - 1) go(0);
    timer = setInterval(() => (Number(slider.value) >= ticks.length - 1 ? stop() : go(Number(slider.value) + 1)), 220);
  });
  slider.addEventListener("input", () => go(Number(slider.value)));
  const panel = element("section", {}, element("div", { class: "steps", hidden: ticks.length === 1 }, play, slider), value);
  const section = element(
    "div",
    { class: "bodies" },
    element("div", { class: "side" }, ...bodies.map((body) => body.section)),
    panel,
  );
  const start = async () => {
    await Promise.all(bodies.map((body) => body.load()));
    share_ranges(bodies);
    const [lead, ...others] = bodies;
    const warp = Math.min(...bodies.map((body) => body.warp));
    for (const body of bodies) body.warp = warp;
    bodies.forEach((body, k) => {
      const { state, scale, choices } = body.show();
      body.section.append(state);
      if (k === 0) panel.append(scale, ...choices);
      body.go = (frame) => go(Number(slider.value) + frame - body.frame); // the keys of the picture
      body.first = () => go(0);
      body.last = () => go(ticks.length - 1);
      body.play = () => play.click();
    });
    share_scale(bodies);
    lead.followers = others;
    go(ticks.length - 1);
    for (const body of bodies)
      body.scene.on_camera(() => {
        for (const other of bodies) if (other !== body) other.scene.see_as(body.scene);
      });
  };
  const repaint = () => bodies.forEach((body) => body.repaint());
  return { section, start, repaint };
}
