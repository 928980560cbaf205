// What a body can be coloured by: its fields and its displacement, each with its range and colours.
import { diverging } from "./colours.js";

function quantile_range(blocks, scale) {
  const sample = [];
  const every = Math.max(1, Math.floor((blocks.length * blocks[0].length) / 60000));
  let k = 0;
  for (const block of blocks)
    for (; k < block.length || ((k -= block.length), false); k += every) sample.push(block[k]);
  sample.sort((a, b) => a - b);
  const at = (q) => scale * sample[Math.min(sample.length - 1, Math.floor(q * sample.length))];
  return [at(0.002), at(0.998)];
}

function range_of_component(data, moves) {
  if (!data.vibrates) return [data.displacement[data.component].from, data.displacement[data.component].to];
  const most = moves[data.component][0].reduce((a, b) => Math.max(a, Math.abs(b)), 0);
  return [-most, most];
}

/** Of the data of a body and its unpacked numbers; `most`: the largest displacement [m]. */
export function quantities_of(data, moves, fields, most) {
  const displacement = {
    name: "displacement",
    unit: data.displacement_unit.name,
    factor: data.displacement_unit.factor,
    at_points: (f, i) => Math.hypot(...moves.map((axis) => axis[f][i])),
    range: [0, most * data.displacement_unit.factor],
  };
  const component = {
    name: `displacement ${"xyz"[data.component]}`,
    unit: displacement.unit,
    factor: displacement.factor,
    at_points: (f, i) => moves[data.component][f][i],
    range: range_of_component(data, moves).map((v) => v * displacement.factor),
  };
  const quantities = data.fields.map((field, k) => ({
    ...field,
    at_cells: fields[k],
    range: field.name === "damage" ? [0, 1] : quantile_range(fields[k], field.factor),
  }));
  quantities.push(displacement, component);
  for (const q of quantities) {
    q.map = q.range[0] < 0 && q.range[1] > 0 ? diverging : q.name === "damage" ? "light to dark" : "viridis";
    if (q.map === diverging) q.range = [-1, 1].map((s) => s * Math.max(-q.range[0], q.range[1]));
    if (!(q.range[0] < q.range[1])) q.range = [q.range[0], q.range[0] + (Math.abs(q.range[0]) || 1)];
  }
  return quantities;
}
