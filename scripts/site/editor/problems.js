// Faults as the engine lists them (scripts/wasm/engine.mjs), in places of a text.

/** Offset in a line of a column, from 1, which counts code points: a string of JavaScript has two units for some. */
const offsetOf = (line, column) => [...line].slice(0, Math.max(0, column - 1)).join("").length;

/** Returns where a problem {line, column, end} is in a text: {from, to}, at least one character where there is one. */
export function placeOf(text, { line, column, end }) {
    const lines = text.split("\n"), n = Math.min(Math.max(line, 1), lines.length) - 1;
    const start = lines.slice(0, n).reduce((sum, l) => sum + l.length + 1, 0), row = lines[n];
    const from = offsetOf(row, column), to = end > column ? offsetOf(row, end) : row.length;
    const left = column > 0 ? Math.min(from, row.length) : /^\s*/.exec(row)[0].length;
    return { from: start + left, to: start + Math.max(left, Math.min(to, row.length)) };
}

/** "dodge.lua:4:22" */
export const placeText = ({ file, line, column }) => [file.split("/").pop(), line || null, line && column ? column : null].filter((part) => part !== null).join(":");

/** The message, and the way out if there is one. */
export const problemText = ({ text, wayOut }) => (wayOut ? `${text}. ${wayOut}` : text);
