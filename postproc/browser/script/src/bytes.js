// The binary parts of the page: base64 of zlib streams of 16 bit numbers, each block a frame.

async function inflated(id) {
  const text = document.getElementById(id).textContent.trim();
  const packed = Uint8Array.from(atob(text), (c) => c.charCodeAt(0));
  const stream = new Blob([packed]).stream().pipeThrough(new DecompressionStream("deflate"));
  return new Uint8Array(await new Response(stream).arrayBuffer());
}

/**
 * `rows` blocks of `n` numbers of 16 bits: low bytes of a block, then its high bytes; each block is the difference to
 * the one before it.
 */
async function blocks16(id, rows, n) {
  const bytes = await inflated(id);
  const blocks = [];
  let before = new Uint16Array(n);
  for (let r = 0; r < rows; ++r) {
    const block = new Uint16Array(n);
    const at = 2 * r * n;
    for (let i = 0; i < n; ++i) block[i] = before[i] + bytes[at + i] + 256 * bytes[at + n + i];
    blocks.push(block);
    before = block;
  }
  return blocks;
}

/** Numbers between `from` and `to`, in `rows` blocks of `n`. */
export async function quantised({ id, from, to }, rows, n) {
  const step = (to - from) / 65535;
  return (await blocks16(id, rows, n)).map((block) => Float32Array.from(block, (v) => from + step * v));
}

/** n unsigned numbers of 32 bits as four planes of bytes, each number the difference to the one before it. */
export async function integers({ id, n }) {
  const bytes = await inflated(id);
  const values = new Int32Array(n);
  let before = 0;
  for (let i = 0; i < n; ++i) {
    before = (before + bytes[i] + 256 * (bytes[n + i] + 256 * (bytes[2 * n + i] + 256 * bytes[3 * n + i]))) | 0;
    values[i] = before;
  }
  return values;
}

export async function octets({ id }) {
  return inflated(id);
}
