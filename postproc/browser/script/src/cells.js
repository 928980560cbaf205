// The surface of what is shown of the cells: of whole ones, and of those that a plane cuts, with the cut itself.

/** Faces of the shapes by their corners, outwards (VTK's order). */
const faces_of_shape = {
  4: [
    [0, 1, 3],
    [1, 2, 3],
    [2, 0, 3],
    [0, 2, 1],
  ],
  5: [
    [0, 3, 2, 1],
    [0, 1, 4],
    [1, 2, 4],
    [2, 3, 4],
    [3, 0, 4],
  ],
  6: [
    [0, 1, 2],
    [3, 5, 4],
    [0, 3, 4, 1],
    [1, 4, 5, 2],
    [2, 5, 3, 0],
  ],
  8: [
    [0, 4, 7, 3],
    [1, 2, 6, 5],
    [0, 1, 5, 4],
    [3, 7, 6, 2],
    [0, 3, 2, 1],
    [4, 5, 6, 7],
  ],
};

export const beyond = -2; // a neighbour that the page does not have
const outside = -1;

/** Cells with the faces that follow from their shapes, and what is behind each face. */
export class Cells {
  /**
   * `shape`: 4, 5, 6, 8 corners, or 0 for a polyhedron, whose `stream` has its number of faces and, of each, the number
   * of its corners and these. `corners`: of the other shapes, cell by cell. `base`: the point of the mesh that a corner
   * is at; where cracks part the cells, several corners are at one.
   */
  constructor({ shape, corners, stream, region, base, open }) {
    this.n = shape.length;
    this.region = region;
    this.base = base;
    this.n_base = base.reduce((most, p) => Math.max(most, p), 0) + 1;
    const face_at = new Int32Array(this.n + 1);
    const corner_at = [0];
    const flat = [];
    let c = 0;
    let s = 0;
    for (let i = 0; i < this.n; ++i) {
      if (shape[i] === 0) {
        for (let k = stream[s++]; k > 0; --k) {
          for (let m = stream[s++]; m > 0; --m) flat.push(corners[c++]);
          corner_at.push(flat.length);
        }
      } else {
        for (const face of faces_of_shape[shape[i]]) {
          for (const k of face) flat.push(corners[c + k]);
          corner_at.push(flat.length);
        }
        c += shape[i];
      }
      face_at[i + 1] = corner_at.length - 1;
    }
    this.face_at = face_at;
    this.corner_at = Int32Array.from(corner_at);
    this.corners = Int32Array.from(flat);
    this.find_neighbours(open);
  }

  /** Faces with the same points are one; `open` says of lone ones whether they are the body's surface. */
  find_neighbours(open) {
    const n_faces = this.corner_at.length - 1;
    this.owner = new Int32Array(n_faces);
    for (let i = 0; i < this.n; ++i) this.owner.fill(i, this.face_at[i], this.face_at[i + 1]);
    this.neighbour = new Int32Array(n_faces).fill(outside);
    this.torn = new Uint8Array(n_faces);
    const at = new Map();
    for (let f = 0; f < n_faces; ++f) {
      const key = this.key_of(f);
      const other = at.get(key);
      if (other === undefined) {
        at.set(key, f);
        continue;
      }
      at.delete(key);
      this.neighbour[f] = this.owner[other];
      this.neighbour[other] = this.owner[f];
      if (this.sum_of(f) !== this.sum_of(other)) this.torn[f] = this.torn[other] = 1;
    }
    if (!open) return;
    let k = 0;
    for (let f = 0; f < n_faces; ++f) if (this.neighbour[f] === outside && open[k++] === 0) this.neighbour[f] = beyond;
  }

  /** The least two of a face's points and its last one. Two faces of cells that share three points are one. */
  key_of(f) {
    let least = Infinity;
    let second = Infinity;
    let most = -1;
    for (let k = this.corner_at[f]; k < this.corner_at[f + 1]; ++k) {
      const p = this.base[this.corners[k]];
      if (p < least) {
        second = least;
        least = p;
      } else if (p < second) second = p;
      if (p > most) most = p;
    }
    const n = this.n_base;
    return n < 200000 ? (least * n + second) * n + most : `${least} ${second} ${most}`; // below 2^53
  }

  sum_of(f) {
    let sum = 0;
    for (let k = this.corner_at[f]; k < this.corner_at[f + 1]; ++k) sum += this.corners[k];
    return sum;
  }
}

/** Polygons that grow: each vertex on the way from corner a to corner b. */
class Soup {
  constructor() {
    this.a = [];
    this.b = [];
    this.t = [];
    this.cell = []; // per triangle
    this.lines = []; // pairs of vertices, as (a, b, t) each
    this.borders = [];
  }

  vertex([a, b, t]) {
    this.a.push(a);
    this.b.push(b);
    this.t.push(t);
  }

  polygon(rim, cell) {
    for (let k = 1; k + 1 < rim.length; ++k) {
      this.vertex(rim[0]);
      this.vertex(rim[k]);
      this.vertex(rim[k + 1]);
      this.cell.push(cell);
    }
    for (let k = 0; k < rim.length; ++k) this.lines.push(rim[k], rim[(k + 1) % rim.length]);
  }
}

const away = 0;
const crossed = 1;
const whole = 2;

/** What a plane leaves of each cell that is shown. `side`: signed distance of each corner, kept where it is negative. */
function states_of(cells, shown, side) {
  const state = new Uint8Array(cells.n);
  for (let i = 0; i < cells.n; ++i) {
    if (!shown[i]) continue;
    if (!side) {
      state[i] = whole;
      continue;
    }
    let least = Infinity;
    let most = -Infinity;
    for (let k = cells.corner_at[cells.face_at[i]]; k < cells.corner_at[cells.face_at[i + 1]]; ++k) {
      const s = side[cells.corners[k]];
      if (s < least) least = s;
      if (s > most) most = s;
    }
    state[i] = most <= 0 ? whole : least >= 0 ? away : crossed;
  }
  return state;
}

/** Where the rim of face f, cut by the plane, runs, and where it crosses it. */
function clipped(cells, f, side) {
  const rim = [];
  const crossings = [];
  const from = cells.corner_at[f];
  const n = cells.corner_at[f + 1] - from;
  for (let k = 0; k < n; ++k) {
    const a = cells.corners[from + k];
    const b = cells.corners[from + ((k + 1) % n)];
    if (side[a] <= 0) rim.push([a, a, 0]);
    if (side[a] <= 0 !== side[b] <= 0) {
      const [p, q] = a < b ? [a, b] : [b, a]; // the same vertex for both cells at an edge
      const at = [p, q, side[p] / (side[p] - side[q])];
      rim.push(at);
      crossings.push(at);
    }
  }
  return [rim, crossings];
}

const rim_of = (cells, f) =>
  Array.from(cells.corners.subarray(cells.corner_at[f], cells.corner_at[f + 1]), (c) => [c, c, 0]);

/** Segments of a convex section, one after the other. */
function joined(segments) {
  const same = (p, q) => p[0] === q[0] && p[1] === q[1];
  const rest = segments.slice(1);
  const rim = [...segments[0]];
  while (rest.length > 0) {
    const last = rim[rim.length - 1];
    const k = rest.findIndex(([p, q]) => same(p, last) || same(q, last));
    if (k < 0) break;
    const [p, q] = rest.splice(k, 1)[0];
    rim.push(same(p, last) ? q : p);
  }
  if (rim.length > 2 && same(rim[0], rim[rim.length - 1])) rim.pop();
  return rim;
}

/**
 * Triangles of the surface of the cells with `shown`, as far as the plane leaves them, and of the cut. Where cracks part
 * cells without leaving any out, both sides are there. Lines: outlines of the faces; borders: between regions on the cut.
 */
export function surface_of(cells, shown, side) {
  const soup = new Soup();
  const state = states_of(cells, shown, side);
  for (let i = 0; i < cells.n; ++i) {
    if (state[i] === away) continue;
    const segments = [];
    for (let f = cells.face_at[i]; f < cells.face_at[i + 1]; ++f) {
      const other = cells.neighbour[f];
      const hidden = other === beyond || (other >= 0 && state[other] !== away && !cells.torn[f]);
      if (state[i] === whole) {
        if (!hidden) soup.polygon(rim_of(cells, f), i);
        continue;
      }
      const [rim, crossings] = clipped(cells, f, side);
      if (crossings.length === 2) {
        segments.push(crossings);
        const border = other < 0 ? other !== beyond : !shown[other] || cells.region[other] !== cells.region[i];
        if (border) soup.borders.push(...crossings);
      }
      if (!hidden && rim.length > 2) soup.polygon(rim, i);
    }
    if (segments.length > 2) soup.polygon(joined(segments), i);
  }
  return soup;
}
