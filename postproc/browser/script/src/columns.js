// Columns of the runs of a sweep: words, unit, values; what their pictures need.
import { element } from "./elements.js";

export const title_of = (column) => (column.unit ? `${column.words} [${column.unit}]` : column.words);
export const is_number = (v) => v !== null && Number.isFinite(v);

/** Least and most of what is a number; a little apart where there is one value alone. */
export function ends_of(values) {
  const numbers = values.filter(is_number);
  if (numbers.length === 0) return [0, 1];
  const [least, most] = [Math.min(...numbers), Math.max(...numbers)];
  return least < most ? [least, most] : [least - (Math.abs(least) || 1), most + (Math.abs(most) || 1)];
}

/** A menu of columns, which calls act(column). */
export function choice(columns, chosen, act) {
  const select = element(
    "select",
    { onchange: () => act(columns[select.selectedIndex]) },
    ...columns.map((column) => element("option", { selected: column === chosen }, column.words)),
  );
  return select;
}
