// The tutorial of behaviours/README.md as lessons: texts, and the files that each section writes.

const REPORTED = /^`step\d[\w/.]*`: (\w)/; // a picture of a report that the text tells of
const HEADING = /^## From an empty file/m;

/** Parts of a line of Markdown: strings, {code}, {bold}, {text, href}. */
export function readInline(text) {
    const parts = [], mark = /`([^`]+)`|\*\*([^*]+)\*\*|\[([^\]]+)\]\(([^)]+)\)/g;
    let at = 0;
    for (const found of text.matchAll(mark)) {
        if (found.index > at) parts.push(text.slice(at, found.index));
        parts.push(found[1] ? { code: found[1] } : found[2] ? { bold: found[2] } : { text: found[3], href: found[4] });
        at = found.index + found[0].length;
    }
    if (at < text.length) parts.push(text.slice(at));
    return parts;
}

/** Blocks of a section: {text: parts}, {file, language, code}, {shell}: also tests. Pictures are left out: the crowd is beside the text. */
function readBlocks(text) {
    const blocks = [], lines = text.split("\n");
    for (let n = 0; n < lines.length; n++) {
        const fence = /^```(\w+)(?: (\S+))?$/.exec(lines[n]);
        if (fence) {
            const end = lines.indexOf("```", n + 1), code = `${lines.slice(n + 1, end).join("\n")}\n`;
            blocks.push(fence[1] === "sh" || fence[2].endsWith("_test.lua") ? { shell: code.trim() } : { file: fence[2], language: fence[1], code });
            n = end;
        } else if (lines[n].trim() && !lines[n].startsWith("![")) {
            let end = n;
            while (lines[end + 1]?.trim() && !/^(```|!\[)/.test(lines[end + 1])) end++;
            const plain = lines.slice(n, end + 1).join(" ").replace(REPORTED, (_, first) => first.toUpperCase());
            blocks.push({ text: readInline(plain) });
            n = end;
        }
    }
    return blocks;
}

/**
 * Returns the sections of the tutorial but those whose titles are in `left`: [{title, blocks, scene, before, after}]. `scene`: the path of
 * the first scene that it writes, else that of the section before; `before` and `after`: files {path: text}.
 */
export function readLessons(markdown, left = []) {
    const start = HEADING.exec(markdown).index;
    let files = {}, scene = null;
    const sections = markdown.slice(start).split(/^### /m).slice(1).map((section) => section.split("\n")).filter(([heading]) => /^\d+\. /.test(heading));
    return sections.map(([heading, ...rest]) => [heading.replace(/^\d+\. /, ""), rest.join("\n")]).filter(([title]) => !left.includes(title)).map(([title, text]) => {
        const blocks = readBlocks(text), before = files;
        files = { ...files, ...Object.fromEntries(blocks.filter((b) => b.file).map((b) => [b.file, b.code])) };
        scene = blocks.find((b) => b.file?.endsWith(".yaml"))?.file ?? scene;
        return { title, blocks, scene, before, after: files };
    });
}
