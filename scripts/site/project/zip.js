// Zip archives of texts, written and read in the browser or under node, by its own compression.

import { pathsFault, plainPath } from "./references.js";

const LOCAL = 0x04034b50, ENTRY = 0x02014b50, END = 0x06054b50;
const DEFLATED = 8, UTF8 = 0x0800, LOCKED = 1;
const MOST_FILES = 500, MOST_BYTES = 16e6; // of what is read, unpacked
export const MOST_PACKED = 32e6; // bytes of an archive that is read

const TABLE = Uint32Array.from({ length: 256 }, (_, n) => {
    let c = n;
    for (let k = 0; k < 8; k++) c = c & 1 ? 0xedb88320 ^ (c >>> 1) : c >>> 1;
    return c >>> 0;
});

/** CRC-32 of bytes (ISO 3309). */
export function checksum(bytes) {
    let c = 0xffffffff;
    for (const b of bytes) c = TABLE[(c ^ b) & 255] ^ (c >>> 8);
    return (c ^ 0xffffffff) >>> 0;
}

/** Sends bytes through a stream of compression; stops with an error beyond `most` bytes. */
async function pump(stream, bytes, most = Infinity) {
    const writer = stream.writable.getWriter(), reader = stream.readable.getReader(), parts = [];
    writer.write(bytes).then(() => writer.close()).catch(() => {}); // the reader meets the same error
    let length = 0;
    for (;;) {
        const { value, done } = await reader.read();
        if (done) break;
        length += value.length;
        if (length > most) throw new Error(`it holds more than ${most / 1e6} MB`);
        parts.push(value);
    }
    const all = new Uint8Array(length);
    let at = 0;
    for (const part of parts) {
        all.set(part, at);
        at += part.length;
    }
    return all;
}

export const deflate = (bytes) => pump(new CompressionStream("deflate-raw"), bytes);
export const inflate = (bytes, most = MOST_BYTES) => pump(new DecompressionStream("deflate-raw"), bytes, most);

function record(...fields) {
    const bytes = new Uint8Array(fields.reduce((sum, [size]) => sum + size, 0)), view = new DataView(bytes.buffer);
    let at = 0;
    for (const [size, value] of fields) {
        if (size === 4) view.setUint32(at, value, true);
        else view.setUint16(at, value, true);
        at += size;
    }
    return bytes;
}

/** Writes files {path: text} into a zip archive; returns its bytes. Files have the date of 1 January 2026, so equal files make equal archives. */
export async function writeZip(files) {
    const coder = new TextEncoder(), parts = [], directory = [];
    let at = 0;
    for (const [path, text] of Object.entries(files)) {
        const name = coder.encode(path), plain = coder.encode(text), packed = await deflate(plain);
        const head = [[2, 20], [2, UTF8], [2, DEFLATED], [2, 0], [2, (46 << 9) | (1 << 5) | 1], [4, checksum(plain)], [4, packed.length], [4, plain.length], [2, name.length], [2, 0]];
        const local = record([4, LOCAL], ...head);
        directory.push(record([4, ENTRY], [2, 20], ...head, [2, 0], [2, 0], [2, 0], [4, 0], [4, at]), name);
        parts.push(local, name, packed);
        at += local.length + name.length + packed.length;
    }
    const size = directory.reduce((sum, part) => sum + part.length, 0), count = directory.length / 2;
    const all = [...parts, ...directory, record([4, END], [2, 0], [2, 0], [2, count], [2, count], [4, size], [4, at], [2, 0])];
    return new Uint8Array(await new Blob(all).arrayBuffer());
}

/** Reads a zip archive: {files: {path: text}, left: paths of what is no text}. Throws an error that says what is wrong with it. */
export async function readZip(bytes) {
    const view = new DataView(bytes.buffer, bytes.byteOffset, bytes.byteLength), coder = new TextDecoder("utf-8", { fatal: true });
    let end = bytes.length - 22;
    while (end >= 0 && view.getUint32(end, true) !== END) end--;
    if (end < 0) throw new Error("this is no zip archive");
    const files = new Map(), left = [], count = view.getUint16(end + 10, true);
    if (count > MOST_FILES) throw new Error(`the archive has ${count} files, ${MOST_FILES} is the limit`);
    let at = view.getUint32(end + 16, true), rest = MOST_BYTES;
    for (let n = 0; n < count; n++) {
        if (at + 46 > bytes.length || view.getUint32(at, true) !== ENTRY) throw new Error("the archive's directory is damaged");
        const isLocked = view.getUint16(at + 8, true) & LOCKED, method = view.getUint16(at + 10, true), sum = view.getUint32(at + 16, true), packed = view.getUint32(at + 20, true), size = view.getUint32(at + 24, true);
        const long = view.getUint16(at + 28, true), more = view.getUint16(at + 30, true) + view.getUint16(at + 32, true), local = view.getUint32(at + 42, true);
        const path = new TextDecoder().decode(bytes.subarray(at + 46, at + 46 + long)).replaceAll("\\", "/"); // names of other encodings keep their ASCII
        at += 46 + long + more;
        if (path.endsWith("/")) continue;
        if (isLocked) throw new Error(`${path} is locked by a password`);
        if (path.startsWith("/") || path.split("/").includes("..")) throw new Error(`${path} leads out of the archive`);
        if (local + 30 > bytes.length) throw new Error(`${path} is cut short`);
        const start = local + 30 + view.getUint16(local + 26, true) + view.getUint16(local + 28, true), content = bytes.subarray(start, start + packed);
        if (method !== 0 && method !== DEFLATED) throw new Error(`${path} is packed by method ${method}, which is not supported`);
        if (size > rest) throw new Error(`it holds more than ${MOST_BYTES / 1e6} MB`);
        const plain = method === 0 ? content : await inflate(content, rest).catch((error) => {
            throw error instanceof TypeError ? new Error(`${path} is damaged`) : error; // a TypeError is the browser's
        });
        if (plain.length !== size || checksum(plain) !== sum) throw new Error(`${path} is damaged`);
        rest -= plain.length;
        const name = plainPath(path);
        if (files.has(name)) throw new Error(`it has two files ${name}`);
        try {
            files.set(name, coder.decode(plain));
        } catch {
            left.push(path); // no text: a picture, or an archive
        }
    }
    const fault = pathsFault([...files.keys()]);
    if (fault) throw new Error(fault);
    return { files: Object.fromEntries(files), left };
}
