// The whole of an edit in a link's fragment: texts as JSON, compressed, in base64 for addresses.
import { deflate, inflate } from "./zip.js";

const VERSION = 1;
const MOST = 4e6; // bytes of what a link unpacks to

const toBase64 = (bytes) => btoa(Array.from(bytes, (b) => String.fromCharCode(b)).join("")).replaceAll("+", "-").replaceAll("/", "_").replace(/=+$/, "");
const fromBase64 = (text) => Uint8Array.from(atob(text.replaceAll("-", "+").replaceAll("_", "/")), (c) => c.charCodeAt(0));

/** Packs a project {scene, files, lesson} for the fragment of an address. */
export async function packProject({ scene, files, lesson = null }) {
    return toBase64(await deflate(new TextEncoder().encode(JSON.stringify({ version: VERSION, scene, files, lesson }))));
}

/** Unpacks what packProject made. Throws an error that says what is wrong. */
export async function unpackProject(text) {
    let read;
    try {
        read = JSON.parse(new TextDecoder().decode(await inflate(fromBase64(text), MOST)));
    } catch {
        throw new Error("This link is damaged or cut short. Ask for it again, or for the zip.");
    }
    if (read.version !== VERSION) throw new Error(`This link is of another version (${read.version}) of the playground.`);
    const texts = Object.entries(read.files ?? {});
    if (typeof read.scene !== "string" || !texts.every(([, t]) => typeof t === "string") || !(read.scene in read.files)) throw new Error("This link lacks its scene.");
    return { scene: read.scene, files: read.files, lesson: read.lesson ?? null };
}
