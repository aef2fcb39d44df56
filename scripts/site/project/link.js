// The whole of an edit in a link's fragment: texts as JSON, compressed, in base64 for addresses.
import { pathsFault } from "./references.js";
import { deflate, inflate } from "./zip.js";

const VERSION = 1;
const MOST = 4e6; // bytes of what a link unpacks to
const LONGEST = 1.5e6; // characters of a link; browsers open none of over 2 million

const toBase64 = (bytes) => btoa(Array.from(bytes, (b) => String.fromCharCode(b)).join("")).replaceAll("+", "-").replaceAll("/", "_").replace(/=+$/, "");
const fromBase64 = (text) => Uint8Array.from(atob(text.replaceAll("-", "+").replaceAll("_", "/")), (c) => c.charCodeAt(0));

/** Packs a project {scene, files, lesson} for the fragment of an address. Throws an error if it is too large for one. */
export async function packProject({ scene, files, lesson = null }) {
    const bytes = new TextEncoder().encode(JSON.stringify({ version: VERSION, scene, files, lesson })), link = bytes.length > MOST ? null : toBase64(await deflate(bytes));
    if (link === null || link.length > LONGEST) throw new Error("These files are too large for a link. Download a zip.");
    return link;
}

/** Unpacks what packProject made. Throws an error that says what is wrong. */
export async function unpackProject(text) {
    let read;
    try {
        read = JSON.parse(new TextDecoder().decode(await inflate(fromBase64(text), MOST)));
    } catch {
        throw new Error("This link is damaged or cut short. Ask for it again, or for the zip.");
    }
    if (read === null || typeof read !== "object") throw new Error("This link holds no project.");
    if (read.version !== VERSION) throw new Error(`This link is of another version (${read.version}) of the playground.`);
    const texts = Object.entries(read.files ?? {});
    if (typeof read.scene !== "string" || !texts.every(([, t]) => typeof t === "string") || !Object.hasOwn(read.files, read.scene)) throw new Error("This link lacks its scene.");
    const fault = pathsFault(texts.map(([path]) => path));
    if (fault) throw new Error(`This link is damaged: ${fault}.`);
    return { scene: read.scene, files: read.files, lesson: read.lesson ?? null };
}
