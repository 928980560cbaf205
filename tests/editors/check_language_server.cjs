// What an editor with taplo's language server shows of a shipped case: its keys completed and explained by the schema that
// the first line names.
//
// node check_language_server.cjs CASES_DIR; skipped (77) where the module @taplo/lsp is not found (NODE_PATH).
const fs = require("node:fs");
const path = require("node:path");
const url = require("node:url");

function moduleOrSkip(name) {
  try {
    return require(name);
  } catch {
    console.log(`${name} is not installed`);
    process.exit(77);
  }
}
const { TaploLsp } = moduleOrSkip("@taplo/lsp");

globalThis.fetch = () => Promise.reject(new Error("no network is needed"));

const environment = {
  now: () => new Date(),
  envVar: (name) => process.env[name],
  envVars: () => Object.entries(process.env),
  stdErrAtty: () => false,
  stdin: process.stdin,
  stdout: process.stderr,
  stderr: async (bytes) => bytes.length,
  glob: () => [],
  readFile: (file) => fs.promises.readFile(file),
  writeFile: (file, bytes) => fs.promises.writeFile(file, bytes),
  urlToFilePath: (place) => (place.startsWith("file:") ? url.fileURLToPath(place) : ""),
  isAbsolute: (place) => path.isAbsolute(place),
  cwd: () => process.cwd(),
  findConfigFile: () => undefined,
};

/// Requests and what is answered to them.
class Client {
  #server;
  #answers = new Map();
  #n = 0;

  static async start(root) {
    const client = new Client();
    client.#server = await TaploLsp.initialize(environment, { onMessage: (message) => client.#take(message) });
    const folders = [{ uri: root, name: "cases" }];
    await client.ask("initialize", { processId: null, rootUri: root, capabilities: {}, workspaceFolders: folders });
    client.tell("initialized", {});
    return client;
  }
  tell(method, params) {
    this.#server.send({ jsonrpc: "2.0", method, params });
  }
  ask(method, params) {
    const id = ++this.#n;
    const answer = new Promise((resolve) => this.#answers.set(id, resolve));
    this.#server.send({ jsonrpc: "2.0", id, method, params });
    return answer;
  }
  #take(message) {
    const asks = message.method !== undefined && message.id !== undefined;
    if (asks) this.#server.send({ jsonrpc: "2.0", id: message.id, result: (message.params?.items ?? []).map(() => ({})) });
    else this.#answers.get(message.id)?.(message.result);
  }
}

async function main() {
  const cases = path.resolve(process.argv[2]);
  const client = await Client.start(url.pathToFileURL(cases).href);
  const file = path.join(cases, "bar_at2", "case.toml");
  const textDocument = { uri: url.pathToFileURL(file).href };
  const lines = fs.readFileSync(file, "utf8").split("\n");
  const line = lines.findIndex((text) => text.startsWith("toughness ="));
  lines.splice(line + 1, 0, "");  // where a key is to be typed, in [materials.concrete]
  client.tell("textDocument/didOpen", { textDocument: { ...textDocument, languageId: "toml", version: 1, text: lines.join("\n") } });

  const faults = [];
  const hover = await client.ask("textDocument/hover", { textDocument, position: { line, character: 3 } });
  const words = hover?.contents?.value ?? "";
  for (const part of ["Fracture toughness", "energy per area", "Default: "])
    if (!words.includes(part)) faults.push(`hover on toughness lacks "${part}": ${words.slice(0, 500)}`);

  const found = await client.ask("textDocument/completion", { textDocument, position: { line: line + 1, character: 0 } });
  const labels = new Set((found?.items ?? found ?? []).map((item) => item.label));
  for (const key of ["strength", "density", "expansion"]) if (!labels.has(key)) faults.push(`completion lacks ${key}`);
  for (const key of ["toughness", "patch", "generator", "strenght"])
    if (labels.has(key)) faults.push(`completion offers ${key}`);
  console.log(faults.join("\n") || `${labels.size} keys offered, toughness explained`);
  process.exit(faults.length > 0 ? 1 : 0);
}

main();
