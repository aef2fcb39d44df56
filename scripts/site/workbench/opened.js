// What an address opens: "#scene=NAME" a shipped scene, "#lesson=N" a lesson, "#edit=..." the edit that a link carries, "#work=NAME" work
// on such an edit that the browser keeps. Work that was left unsaved on a scene, a lesson or a link comes back.
import { Draft } from "../project/draft.js";
import { unpackProject } from "../project/link.js";
import { checksum } from "../project/zip.js";

const FIRST = "dodgeball"; // the scene of an address that names none

/** Loads JSON; `missing`: what to say if the server has no such file. */
async function fetchJson(path, missing = `The playground lacks ${path}.`) {
    const early = globalThis.earlyAnswer; // that early.js has asked for
    globalThis.earlyAnswer = null;
    const answer = await (early?.path === path ? early.answer : fetch(path));
    if (!answer.ok) throw new Error(missing);
    return answer.json();
}

async function openScene(name) {
    const scene = `scenes/${name}.yaml`, { files, installed } = /^[\w-]+$/.test(name) ? await fetchJson(`data/scenes/${name}.json`, `There is no scene "${name}".`) : {};
    if (!files) throw new Error(`There is no scene "${name}".`);
    return { name: `scene:${name}`, title: titleOf(files[scene], scene), scene, files, installed };
}

/** The lesson of a number from 0, the nearest if there is none. */
const lessonAt = (lessons, number) => Math.min(Math.max(Math.floor(Number(number)) || 0, 0), lessons.length - 1);

/** The files with which a lesson begins: an empty scene in place of what the lesson is to write. */
export function lessonFiles(lesson) {
    return { [lesson.scene]: "# The scene goes here.\n", ...lesson.before };
}

async function openLesson(number) {
    const { lessons } = await fetchJson("data/lessons.json"), at = lessonAt(lessons, Number(number) - 1);
    return { name: "lesson", title: "Dodge-ball, step by step", scene: lessons[at].scene, files: lessonFiles(lessons[at]), lessons, lesson: at };
}

async function openLink(text) {
    const { scene, files, lesson } = await unpackProject(text), name = `link:${checksum(new TextEncoder().encode(text))}`;
    if (lesson === null) return { name, title: titleOf(files[scene], scene), scene, files };
    const { lessons } = await fetchJson("data/lessons.json");
    return { name, title: "Dodge-ball, step by step", scene, files, lessons, lesson: lessonAt(lessons, lesson) };
}

async function openWork(name) {
    const kept = new Draft(name).find();
    if (!kept) throw new Error("This browser no longer keeps that work.");
    const { lessons } = kept.lesson === undefined ? {} : await fetchJson("data/lessons.json");
    return { name, title: kept.title ?? titleOf(kept.files[kept.scene], kept.scene), scene: kept.scene, files: {}, ...(lessons ? { lessons, lesson: lessonAt(lessons, kept.lesson) } : {}) };
}

const OPENERS = new Map([["scene", openScene], ["lesson", openLesson], ["edit", openLink], ["work", openWork]]);

export function titleOf(text, path) {
    return /^title: *["']?(.*?)["']?\s*$/m.exec(text ?? "")?.[1] || path.split("/").pop();
}

/**
 * Finds what an address opens: {name, title, scene, files, installed, texts, lessons, lesson, restored, fault}. `files` is what it
 * names, `installed` the shipped files that these need (undefined: not known), `texts` what is shown: work that was left, from the time
 * `restored` (ms since 1970), else the same.
 */
export async function findOpened({ hash }) {
    const [kind, value] = /^#(\w+)=(.*)$/.exec(hash)?.slice(1) ?? ["scene", FIRST];
    let opened, fault = null;
    try {
        opened = await (OPENERS.get(kind) ?? openScene)(decodeURIComponent(value));
    } catch (error) {
        fault = error instanceof URIError ? "This address is damaged." : error.message;
        opened = await openScene(FIRST);
    }
    const kept = new Draft(opened.name).find();
    const same = kept && JSON.stringify(kept.files) === JSON.stringify(opened.files);
    const restored = kept && !same ? kept.time : null;
    return { ...opened, fault, restored, installed: restored ? undefined : opened.installed, texts: restored ? kept.files : opened.files, scene: restored ? kept.scene : opened.scene, lesson: restored && opened.lessons && kept.lesson !== undefined ? lessonAt(opened.lessons, kept.lesson) : opened.lesson };
}
