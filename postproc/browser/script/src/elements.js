// Elements of the page. Texts go into text nodes alone: nothing of a case is ever taken for HTML.

/** `children`: elements or texts. */
export function element(tag, attributes = {}, ...children) {
  const made = document.createElement(tag);
  for (const [name, value] of Object.entries(attributes)) {
    if (name.startsWith("on")) made.addEventListener(name.slice(2), value);
    else if (value === true) made.setAttribute(name, "");
    else if (value !== false && value !== undefined) made.setAttribute(name, value);
  }
  made.append(...children.filter((child) => child !== null && child !== undefined));
  return made;
}

/** As element(), of a picture in SVG. */
export const svg = (tag, attributes = {}, ...children) => {
  const made = document.createElementNS("http://www.w3.org/2000/svg", tag);
  for (const [name, value] of Object.entries(attributes)) made.setAttribute(name, value);
  made.append(...children);
  return made;
};

/** The value of a custom property, as "--ink". */
export const colour_of = (name) => getComputedStyle(document.documentElement).getPropertyValue(name).trim();

export const is_dark = () => document.documentElement.dataset.theme === "dark";

/** Four digits. */
export function shown(value) {
  if (!Number.isFinite(value)) return "-";
  if (value === 0) return "0";
  const size = Math.abs(value);
  if (size >= 1e6 || size < 1e-3) return value.toExponential(3).replace(/\.?0+e/, "e");
  return String(Number(value.toPrecision(size >= 1e4 ? 6 : 4)));
}

/** Calls `act` after the size of an element has changed, and once what is built now is in the page. */
export function on_size(watched, act) {
  setTimeout(act);
  new ResizeObserver(() => setTimeout(act)).observe(watched);
}

/** A cell of a CSV file. */
export const quoted = (text) => (/[",\n]/.test(text) ? `"${text.replaceAll('"', '""')}"` : text);

/** Gives the reader a file. */
export function save(name, content, type) {
  const link = element("a", { href: URL.createObjectURL(new Blob([content], { type })), download: name });
  link.click();
  setTimeout(() => URL.revokeObjectURL(link.href), 1000);
}

/** A name of a file from a caption. */
export const file_name = (caption) =>
  caption
    .toLowerCase()
    .replace(/[^a-z0-9]+/g, "_")
    .replace(/^_|_$/g, "")
    .slice(0, 60) || "data";
