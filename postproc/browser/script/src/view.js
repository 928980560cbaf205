// From where a body is looked at first: at its cut, or at a plate from above.

const across = (a, b) => [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]];
const dot = (a, b) => a[0] * b[0] + a[1] * b[1] + a[2] * b[2];

/** Least and most of each coordinate, of the body as it is and as it has moved in its last frame. */
function extent_of(body) {
  const last = body.data.frames.length - 1;
  return body.moves.map((axis, c) => {
    let low = body.lower[c];
    let high = body.upper[c];
    for (let i = 0; i < axis[last].length; ++i) {
      const v = body.places[c][i] + body.warp * axis[last][i];
      if (v < low) low = v;
      if (v > high) high = v;
    }
    return [low, high];
  });
}

/** From the body towards the eye, and what is up. */
function directions_of(body) {
  const { size, cut, is_flat } = body;
  if (is_flat) {
    const axis = body.data.flat_axis;
    const directions = [
      [1, 0, 0],
      [0, -1, 0],
      [0, 0, 1],
    ];
    return [directions[axis], axis === 2 ? [0, 1, 0] : [0, 0, 1]];
  }
  const is_thin = size[2] < 0.3 * Math.min(size[0], size[1]);
  const from_above = cut.axis === 2 || (cut.axis < 0 && is_thin);
  const aside = from_above ? [0.4, -0.5, 0.77] : [0.42, -0.86, 0.28];
  return [cut.axis === 0 ? [0.86, -0.42, 0.28] : aside, [0, 0, 1]];
}

/** `body`: a Body; width and height of its picture. Middle, direction, up, and half the height that is to be seen. */
export function first_view(body, { width, height }) {
  const [direction, up] = directions_of(body);
  const extent = extent_of(body);
  const half = extent.map(([low, high]) => (high - low) / 2);
  const reach = (axis) => dot(axis.map(Math.abs), half) / Math.hypot(...axis);
  const right = across(direction, up);
  const above = up.map((v, i) => v - direction[i] * dot(up, direction));
  const seen = 1.08 * Math.max(reach(above), (reach(right) * height) / Math.max(1, width));
  return { middle: extent.map(([low, high]) => (low + high) / 2), direction, up, seen };
}
