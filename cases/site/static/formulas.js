// Draws the formulas that Sphinx has marked by \( \) and \[ \], by Debian's KaTeX beside this file.
(() => {
  const folder = document.currentScript.src.replace(/[^/]*$/, "");
  const load = (name) =>
    new Promise((loaded, failed) => {
      const script = Object.assign(document.createElement("script"), { src: folder + name, onload: loaded, onerror: failed });
      document.head.append(script);
    });
  addEventListener("DOMContentLoaded", async () => {
    await load("katex.min.js");
    for (const element of document.querySelectorAll(".math")) {
      const text = element.textContent.trim();
      const formula = text.replace(/^\\[([]/, "").replace(/\\[)\]]$/, "");
      katex.render(formula, element, { displayMode: text.startsWith("\\["), throwOnError: false });
    }
  });
})();
