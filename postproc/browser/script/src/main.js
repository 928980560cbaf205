// The page: everything that its data say, one section after the other.
import uplot_css from "uplot/dist/uPlot.min.css";
import page_css from "./page.css";
import { bodies_section } from "./bodies.js";
import { Body } from "./body.js";
import { chart_section } from "./chart.js";
import { element, save } from "./elements.js";
import { keep_theme, kept_theme, live_section } from "./live.js";
import { picture_section } from "./picture.js";
import { runs_sections } from "./runs.js";

const data = JSON.parse(document.getElementById("pfdm-data").textContent);
const repaints = [];
const redraws = [];

function table_section(table) {
  const rows = table.rows.map((cells, i) =>
    element("tr", {}, ...cells.map((cell) => element(i === 0 && table.has_header ? "th" : "td", {}, cell))),
  );
  const is_broad = data.first && (table.rows[0]?.length ?? 0) > 3;
  return element(
    "section",
    { class: is_broad ? "broad" : "" },
    element("h2", {}, table.caption),
    element("div", { class: "scrolls" }, element("table", {}, ...rows)),
  );
}

const text_section = (text) =>
  element(
    "section",
    {},
    element("h2", {}, text.caption),
    ...text.lines.map((line) => element("p", { style: "margin: 0 0 6px; overflow-wrap: anywhere" }, line)),
  );

const makers = {
  chart: (block, link) => chart_section(block, link),
  table: table_section,
  text: text_section,
  picture: (block) => picture_section(block),
};

function section_of(block, link) {
  const section = makers[block.kind](block, link);
  if (section.repaint) repaints.push(section.repaint);
  if (section.redraw && block.kind === "chart") redraws.push(section.redraw);
  return section;
}

function set_theme(theme) {
  document.documentElement.dataset.theme = theme;
  for (const repaint of repaints) repaint();
}

function head() {
  const other = () => {
    set_theme(document.documentElement.dataset.theme === "dark" ? "light" : "dark");
    keep_theme(document.documentElement.dataset.theme);
  };
  return element(
    "header",
    {},
    element("div", {}, element("h1", {}, data.title), element("p", { class: "faint" }, data.subtitle)),
    element("button", { onclick: other, title: "Dark or light" }, "\u25d0"),
  );
}

const figure = ({ label, value, note }) =>
  element(
    "div",
    { class: "figure" },
    element("span", {}, label),
    element("b", {}, value),
    note ? element("span", {}, note) : null,
  );

function keys_off_defaults(keys) {
  const row = (tag, cells) => element("tr", {}, ...cells.map((cell) => element(tag, {}, cell)));
  return element(
    "details",
    {},
    element("summary", {}, `Keys off their defaults (${keys.length})`),
    element(
      "div",
      { class: "scrolls" },
      element("table", { class: "keys" }, row("th", ["key", "value", "default"]), ...keys.map((cells) => row("td", cells))),
    ),
  );
}

function origin() {
  const rows = data.origin.map(([name, value]) => element("tr", {}, element("td", {}, name), element("td", {}, value)));
  const section = element("section", {}, element("h2", {}, "Where it comes from"), element("table", {}, ...rows));
  if (data.command) section.append(element("p", {}, "Made again by ", element("code", {}, data.command)));
  if (data.keys) section.append(keys_off_defaults(data.keys));
  if (data.case_text)
    section.append(
      element(
        "details",
        {},
        element("summary", {}, "The case file as it ran"),
        element("p", {}, element("button", { onclick: () => save("case.toml", data.case_text, "text/plain") }, "Save")),
        element("pre", {}, data.case_text),
      ),
    );
  return section;
}

function told_when_shown(start, holder) {
  start.then(
    () => (document.documentElement.dataset.body = "shown"),
    (error) => {
      document.documentElement.dataset.body = "missing";
      holder.replaceChildren(
        element("p", { style: "padding: 20px" }, `The body cannot be shown: ${error.message}. The curves do without.`),
      );
    },
  );
}

function side_by_side() {
  const { section, start, repaint } = bodies_section(data.bodies, data.bodies_axis);
  repaints.push(repaint);
  return { section, started: () => told_when_shown(start(), section) };
}

function stage(link_holder) {
  if (data.bodies) return side_by_side();
  if (!data.body) return null;
  let row = data.body.frames[data.body.frames.length - 1];
  const body = new Body(data.body, data.steps, (now) => {
    row = now;
    for (const redraw of redraws) redraw();
  });
  const nearest_frame = () => data.body.frames.indexOf(row);
  link_holder.link = { row: () => row, go: (to) => body.go_to_row(to), move: (by) => body.go(nearest_frame() + by) };
  const right = element("div", { style: "display: grid; gap: 14px; align-content: start; min-width: 0" });
  for (const caption of data.beside) {
    const at = data.blocks.findIndex((block) => block.caption === caption);
    if (at >= 0) right.append(section_of(data.blocks.splice(at, 1)[0], link_holder.link));
  }
  repaints.push(() => body.repaint());
  const started = () => told_when_shown(body.start(), body.holder);
  return { section: element("div", { class: "pair stage" }, body.section, right), started };
}

function build() {
  document.head.append(element("style", {}, uplot_css + page_css));
  document.documentElement.dataset.theme =
    kept_theme() ?? (matchMedia("(prefers-color-scheme: dark)").matches ? "dark" : "light");
  const holder = {};
  const main = element("main", {}, head());
  if (data.live) main.append(live_section(data.live));
  if (data.headline.length)
    main.append(element("div", { class: "headline" }, ...data.headline.map((line) => element("p", {}, line))));
  if (data.figures.length) main.append(element("div", { class: "figures" }, ...data.figures.map(figure)));
  if (data.warnings.length)
    main.append(
      element(
        "section",
        { class: "warnings" },
        element("h2", {}, `Warnings (${data.warnings.length})`),
        element("ul", {}, ...data.warnings.map((w) => element("li", {}, w))),
      ),
    );
  for (const block of data.first ?? []) {
    const section = section_of(block);
    section.querySelector(".scrolls")?.classList.add("tall");
    main.append(element("div", { class: "wide" }, section));
  }
  const shown_body = stage(holder);
  if (shown_body) main.append(shown_body.section);
  if (data.runs) {
    const sections = runs_sections(data.runs);
    for (const section of sections) repaints.push(() => section.repaint?.());
    main.append(...sections);
  }
  main.append(element("div", { class: "grid" }, ...data.blocks.map((block) => section_of(block, holder.link))));
  main.append(origin());
  document.body.append(main);
  shown_body?.started();
  matchMedia("(prefers-color-scheme: dark)").addEventListener("change", (e) => set_theme(e.matches ? "dark" : "light"));
  let before = null;
  addEventListener("beforeprint", () => {
    before = document.documentElement.dataset.theme;
    set_theme("light");
  });
  addEventListener("afterprint", () => before && set_theme(before));
  document.documentElement.dataset.page = "built";
}

build();
