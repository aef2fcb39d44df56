// What the engine prints of a run, read for the workbench: errors of a behaviour's functions.
import { plainPath } from "./references.js";

const FAULT = /^([^\s:][^:\n]*\.lua):(\d+): (?!warning|note)(.+)$/;

/** Errors in a text that is printed while a scene runs: [{file, line, column, end, severity, code, text, wayOut}], as the engine's faults. */
export function faultsSaid(said) {
    const lines = said.split("\n");
    return lines.flatMap((line, n) => {
        const found = FAULT.exec(line), where = /^ (machine .*?)(?:;|$)/.exec(lines[n + 1] ?? "")?.[1];
        if (!found || !where) return [];
        return [{ file: plainPath(found[1]), line: Number(found[2]), column: 0, end: 0, severity: "error", code: "while-running", text: `${found[3]} (${where}, while it runs)`, wayOut: "" }];
    });
}
