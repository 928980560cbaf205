// Bundles src/ and the libraries of package.json into ../page.js, the one file that the program embeds. It begins with
// the hash of what it was made from, SHA-256 over a line "HASH  NAME" for each file, and the licences of the libraries. A
// word on the command line is another place for the file.
import { createHash } from "node:crypto";
import { existsSync, readFileSync, readdirSync, writeFileSync } from "node:fs";
import { build } from "esbuild";

const here = new URL("./", import.meta.url);
const names = ["build.js", "package-lock.json", "package.json"];
for (const name of readdirSync(new URL("src/", here)).sort()) names.push(`src/${name}`);
const sha256 = (content) => createHash("sha256").update(content).digest("hex");
const sources = sha256(names.map((name) => `${sha256(readFileSync(new URL(name, here)))}  ${name}\n`).join(""));

const made = await build({
  absWorkingDir: here.pathname,
  entryPoints: ["src/main.js"],
  bundle: true,
  minify: true,
  write: false,
  metafile: true,
  format: "iife",
  target: "es2022",
  charset: "utf8",
  legalComments: "none",
  loader: { ".css": "text" },
  define: { "process.env.NODE_ENV": '"production"' },
});

/** Name, version and licence of a package in the bundle. */
function licence_of(name) {
  const folder = new URL(`node_modules/${name}/`, here);
  const { version, license } = JSON.parse(readFileSync(new URL("package.json", folder)));
  const file = ["LICENSE", "LICENSE.md", "LICENSE.txt", "license", "LICENCE"].find((f) =>
    existsSync(new URL(f, folder)),
  );
  const head = () => readFileSync(new URL(`${name}.js`, folder), "utf8").match(/\/\*([^]*?)\*\//)?.[1] ?? "";
  const text = (file ? readFileSync(new URL(file, folder), "utf8") : head()).trim();
  return `${name} ${version}, ${license}\n\n${text}`.replaceAll("*/", "* /").replaceAll("\r", "");
}
const packages = new Set();
for (const input of Object.keys(Object.values(made.metafile.outputs)[0].inputs)) {
  const found = input.match(/node_modules\/((?:@[^/]+\/)?[^/]+)\//);
  if (found) packages.add(found[1]);
}
const licences = [...packages].sort().map(licence_of).join("\n\n----\n\n");

const head = `/* The script of pfdm's pages. Sources: ${sources}. Libraries in it:\n\n${licences}\n*/\n`;
const out = process.argv[2] ?? new URL("../page.js", here).pathname;
writeFileSync(out, `${head}${made.outputFiles[0].text.trimEnd()}\n`);
console.log(`${out}: ${readFileSync(out).length} bytes, with ${[...packages].sort().join(", ")}`);
