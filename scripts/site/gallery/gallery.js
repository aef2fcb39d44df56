// The gallery: finds scenes by words, and lists work that the browser keeps. The build writes the cards into the page.
import { byId, el, fill, say } from "../../../core/view/page/dom.js";
import { addressOf, Draft, listDrafts } from "../project/draft.js";

const find = byId("find"), cards = [...document.querySelectorAll(".card")];

function show() {
    const words = find.value.toLowerCase().split(/\s+/).filter(Boolean);
    let count = 0;
    for (const card of cards) {
        const text = card.textContent.toLowerCase();
        card.hidden = !words.every((w) => text.includes(w));
        count += card.hidden ? 0 : 1;
    }
    for (const subject of document.querySelectorAll("#scenes > section")) subject.hidden = ![...subject.querySelectorAll(".card")].some((c) => !c.hidden);
    say(byId("found"), words.length ? (count === 1 ? "1 scene" : `${count} scenes`) : `${cards.length} scenes`);
}
/** Lists unshared work, which can be gone on with or removed. */
function showWork() {
    const kept = listDrafts();
    byId("work").hidden = kept.length === 0;
    fill(byId("kept"), kept.map((work) => el("li", {}, el("a", { href: `workbench.html${addressOf(work)}` }, work.title),
        el("span", { className: "faint" }, ` ${new Date(work.time).toLocaleString([], { dateStyle: "medium", timeStyle: "short" })} `),
        el("button", { type: "button", "aria-label": `Remove the work on ${work.title}`, onclick: () => {
            if (!confirm(`Remove the work on ${work.title}? It cannot be taken back.`)) return;
            new Draft(work.name).forget();
            showWork();
        } }, "Remove"))));
}

find.addEventListener("input", show);
addEventListener("pageshow", showWork); // also when somebody comes back from the workbench
addEventListener("storage", showWork);
show();
