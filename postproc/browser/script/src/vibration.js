// A body that vibrates: all its frames have one motion, which goes through its phases.
import { element } from "./elements.js";

const n_phases = 24;

export class Vibration {
  /** Takes real and imaginary part from `body.moves`, and puts there what all frames have at a phase. */
  constructor(body) {
    this.body = body;
    this.parts = body.moves;
    const n = body.data.n_points;
    this.now = this.parts.map(() => new Float32Array(n));
    body.moves = this.now.map((axis) => body.data.frames.map(() => axis));
    this.timer = null;
    this.start = this.largest();
    this.set(this.start);
  }

  /** `phase`: in parts of a turn, of which there are n_phases. */
  set(phase) {
    this.phase = phase % n_phases;
    const turn = (2 * Math.PI * this.phase) / n_phases;
    const [cosine, sine] = [Math.cos(turn), Math.sin(turn)];
    this.now.forEach((axis, c) => {
      const [real, imaginary] = this.parts[c];
      for (let i = 0; i < axis.length; ++i) axis[i] = cosine * real[i] - sine * imaginary[i];
    });
  }

  /** The phase at which a point has moved farthest. */
  largest() {
    let best = 0;
    let most = -1;
    for (let phase = 0; phase < n_phases; ++phase) {
      this.set(phase);
      const [x, y, z] = this.now;
      for (let i = 0; i < x.length; ++i) {
        const moved = x[i] * x[i] + y[i] * y[i] + z[i] * z[i];
        if (moved > most) [best, most] = [phase, moved];
      }
    }
    return best;
  }

  go(phase) {
    this.set(phase);
    this.slider.value = (this.phase - this.start + n_phases) % n_phases;
    this.tell();
    this.body.draw();
  }

  tell() {
    this.words.textContent = `${Math.round((360 * Number(this.slider.value)) / n_phases)}\u00b0`;
    this.slider.setAttribute("aria-valuetext", this.words.textContent);
  }

  play() {
    clearInterval(this.timer);
    this.timer = this.timer ? null : setInterval(() => this.go(this.phase + 1), 60);
    this.button.textContent = this.timer ? "\u25a0 Stop" : "\u223f Vibrate";
  }

  controls() {
    this.button = element("button", { onclick: () => this.play(), "aria-label": "vibrate or stop" }, "\u223f Vibrate");
    this.slider = element("input", {
      type: "range",
      min: 0,
      max: n_phases - 1,
      value: 0,
      "aria-label": "phase of the vibration",
      oninput: () => this.go(this.start + Number(this.slider.value)),
    });
    this.words = element("span", { style: "min-width: 3em" });
    this.tell();
    return element("div", { class: "steps" }, this.button, this.slider, element("span", {}, "phase "), this.words);
  }
}
