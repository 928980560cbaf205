// The page of a run that goes on: how far it is, and the page again after a while.
import { element } from "./elements.js";

const late = 60; // s without a new page, beyond ten of the usual times between two

/** `live`: words, share (0 to 1 of the load), every (s between two pages), made (s since 1970). */
export function live_section(live) {
  let held = false;
  const state = element("b", {}, "Running");
  const words = element("span", {}, live.words);
  const hold = element("button", { title: "The page stays as it is" }, "Hold");
  const wait = () => {
    const age = Date.now() / 1000 - live.made;
    const is_late = age > 10 * live.every + late;
    if (is_late) {
      state.textContent = "No news";
      words.textContent = `since ${new Date(1000 * live.made).toLocaleString()}: the run was stopped, or a step takes long. Before: ${live.words}`;
    }
    return 1000 * (is_late ? 30 : Math.max(2, live.every));
  };
  let timer = setTimeout(() => location.reload(), wait());
  hold.addEventListener("click", () => {
    held = !held;
    hold.textContent = held ? "Go on" : "Hold";
    clearTimeout(timer);
    if (!held) timer = setTimeout(() => location.reload(), 500);
  });
  return element(
    "section",
    { class: "live", role: "status" },
    state,
    element("progress", { max: 1, value: live.share, "aria-label": "part of the load that is done" }),
    words,
    hold,
  );
}

/** The theme that a reader has chosen, from one page to the next; where the browser keeps nothing there is none. */
export const kept_theme = () => {
  try {
    return sessionStorage.getItem("pfdm-theme");
  } catch {
    return null;
  }
};
export const keep_theme = (theme) => {
  try {
    sessionStorage.setItem("pfdm-theme", theme);
  } catch {
    // the next page has the system's
  }
};
