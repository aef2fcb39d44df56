// The gallery: finds scenes by words. The build writes the cards into the page.
import { byId, say } from "../../../core/view/page/dom.js";

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
find.addEventListener("input", show);
show();
