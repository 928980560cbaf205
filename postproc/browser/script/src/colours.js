// Colour maps whose lightness rises evenly, safe for the colour-blind: viridis (CC0, by S. van der Walt and N. Smith,
// 16 of its values); the others are even steps in OKLab (B. Ottosson, public domain).

const viridis = "440154481a6c472f7d41448739568c31688e2a788e23888e1f988b22a88435b77954c5687ad151a5db36d2e21bfde725";

function of_hex(text) {
  const rows = [];
  for (let i = 0; i < text.length; i += 6) rows.push([0, 2, 4].map((k) => parseInt(text.slice(i + k, i + k + 2), 16)));
  return rows;
}

function of_oklab([L, a, b]) {
  const l = (L + 0.3963377774 * a + 0.2158037573 * b) ** 3;
  const m = (L - 0.1055613458 * a - 0.0638541728 * b) ** 3;
  const s = (L - 0.0894841775 * a - 1.291485548 * b) ** 3;
  const linear = [
    4.0767416621 * l - 3.3077115913 * m + 0.2309699292 * s,
    -1.2684380046 * l + 2.6097574011 * m - 0.3413193965 * s,
    -0.0041960863 * l - 0.7034186147 * m + 1.707614701 * s,
  ];
  return linear.map((v) => {
    const c = Math.min(1, Math.max(0, v));
    return 255 * (c <= 0.0031308 ? 12.92 * c : 1.055 * c ** (1 / 2.4) - 0.055);
  });
}

const mix = (a, b, t) => a.map((v, i) => v + t * (b[i] - v));

/** 256 colours along straight lines between the given ones. */
function table(rows) {
  const colours = new Uint8Array(3 * 256);
  for (let i = 0; i < 256; ++i) {
    const at = (i / 255) * (rows.length - 1);
    const k = Math.min(rows.length - 2, Math.floor(at));
    mix(rows[k], rows[k + 1], at - k).forEach((v, c) => (colours[3 * i + c] = Math.round(v)));
  }
  return colours;
}

/** Even steps in OKLab along straight lines between the given places. */
function oklab_table(places) {
  const rows = [];
  for (let i = 0; i <= 64; ++i) {
    const at = (i / 64) * (places.length - 1);
    const k = Math.min(places.length - 2, Math.floor(at));
    rows.push(of_oklab(mix(places[k], places[k + 1], at - k)));
  }
  return table(rows);
}

export const colour_maps = {
  viridis: table(of_hex(viridis)),
  "light to dark": oklab_table([
    [0.93, 0, 0.01],
    [0.64, 0.1, 0.09],
    [0.35, 0.12, -0.06],
  ]),
  "blue to yellow": oklab_table([
    [0.28, -0.01, -0.11],
    [0.6, 0, 0],
    [0.92, -0.02, 0.16],
  ]),
  "blue, grey, orange": oklab_table([
    [0.38, -0.03, -0.14],
    [0.93, 0, 0],
    [0.52, 0.12, 0.11],
  ]),
};

export const diverging = "blue, grey, orange";

/** For series of a chart: Okabe and Ito's colours (2008), lighter ones on dark ground. */
export const series_colours = {
  light: ["#0072b2", "#d55e00", "#009e73", "#b0569a", "#b38600", "#3a9bd6", "#333333", "#8a8a8a"],
  dark: ["#56b4e9", "#ff8c42", "#2fd6a5", "#dd8fc6", "#f0c94a", "#8fd0ff", "#eeeeee", "#9a9a9a"],
};
