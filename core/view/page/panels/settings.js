// Settings of the scene's mods, changed while the run goes on: the behaviours that a mod patches are loaded again.
import { el, figure, fill, say } from "../dom.js";
import { unitText } from "../draw/palette.js";

const PATIENCE = 3000; // ms

/** Returns the part of a panel with the settings of all mods; `send(mod, setting, value)` changes one. */
export function settingsPart(mods, allowed, send) {
    return mods.map((mod) => el("section", { className: "settings", "data-mod": mod.name },
        el("h2", {}, mod.title || mod.name),
        mod.settings.map((setting) => settingRow(mod, setting, allowed, send))));
}

function settingRow(mod, setting, allowed, send) {
    const unit = setting.unit ? ` ${unitText(setting.unit)}` : "";
    const from = el("span", { className: "from", role: "status" }, "");
    const row = el("div", { className: "parameter", "data-parameter": `${mod.name} ${setting.name}`, title: setting.meaning },
        el("div", { className: "row" }, el("strong", {}, setting.name), from),
        setting.meaning ? el("p", { className: "faint" }, setting.meaning) : null);
    if (!allowed) {
        row.firstChild.append(`${setting.kind === "number" ? figure(setting.value) : String(setting.value)}${unit}`);
        return row;
    }
    const place = el("div", { className: "row" });
    const build = () => fill(place, control(mod, setting, change), el("span", { className: "faint" }, unit));
    // A value that is taken comes with the next scene message, which builds the panel anew; messages say why one is not.
    const change = (value) => {
        say(from, "is loaded…");
        send(mod.name, setting.name, value);
        setTimeout(() => {
            if (!row.isConnected) return;
            say(from, "not taken so far");
            build();
        }, PATIENCE);
    };
    build();
    row.append(place);
    return row;
}

function control(mod, setting, change) {
    const label = `${setting.name} of ${mod.title || mod.name}`;
    if (setting.kind === "bool") {
        const box = el("input", { type: "checkbox", checked: setting.value, "aria-label": label });
        box.addEventListener("change", () => change(String(box.checked)));
        return box;
    }
    if (setting.kind === "choice") {
        const list = el("select", { "aria-label": label },
            setting.choices.map((choice) => el("option", { value: choice, selected: choice === setting.value }, choice)));
        list.addEventListener("change", () => change(list.value));
        return list;
    }
    const bounded = setting.least > -1e12 && setting.most < 1e12;
    const number = el("input", { type: "number", step: "any", value: setting.value, min: setting.least, max: setting.most, "aria-label": label });
    number.addEventListener("change", () => number.value !== "" && change(number.value));
    if (!bounded) return [number];
    const step = (setting.most - setting.least) / 100;
    const slider = el("input", { type: "range", min: setting.least, max: setting.most, step, value: setting.value, "aria-label": label });
    slider.addEventListener("input", () => (number.value = slider.value));
    slider.addEventListener("change", () => change(slider.value)); // at the end of a drag: a reload takes a moment
    return [slider, number];
}
