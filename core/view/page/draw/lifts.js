// The lifts of a building: each car where it is between storeys, the doors on all storeys, and of the storey where the car stands the
// door as far as it is open.
import * as THREE from "three";
import { makeCar, makeLeaf } from "./building.js";
import { meshOfPile } from "./scenery.js";

const MODES = ["", ", out of use", ", taken by firemen"]; // as the program counts them

export class Lifts {
    constructor(material) {
        this.material = material;
        this.group = new THREE.Group();
        this.lifts = [];
    }

    /** Builds the lifts of a scene. */
    set(storeys) {
        this.storeys = storeys;
        for (const mesh of [...this.group.children]) {
            this.group.remove(mesh);
            mesh.geometry.dispose();
        }
        const add = (pile) => {
            const mesh = meshOfPile(pile, this.material);
            this.group.add(mesh);
            return mesh;
        };
        this.lifts = storeys.lifts.map((lift) => ({
            lift, car: add(makeCar(lift)),
            stops: lift.stops.map(({ storey, door: [a, b] }) => {
                const middle = [(a[0] + b[0]) / 2, (a[1] + b[1]) / 2];
                return { storey, way: [(b[0] - a[0]) / 2, (b[1] - a[1]) / 2], leaves: [[a, middle, -1], [middle, b, 1]].map(([from, to, side]) => ({ side, mesh: add(makeLeaf(from, to)) })) };
            }),
        }));
        this.drawn = null;
    }

    /** What the lifts do in a frame, by name: where the car is, its door, who rides and, of a running scene's `counts`, who waits. */
    describe(frame, counts = []) {
        const { storeys } = this;
        return (frame?.cars ?? []).slice(0, this.lifts.length).map(({ height, open, people, mode }, l) => {
            const nearest = storeys.list[storeys.nearestStorey(height)], stands = Math.abs(height - nearest.height) < 0.01;
            const where = stands ? `at ${nearest.name}, door ${open > 0.99 ? "open" : open > 0.01 ? "half open" : "shut"}` : `moves, near ${nearest.name}`;
            return [this.lifts[l].lift.name, `${where}, ${people === 1 ? "1 person" : `${people} people`}${counts[l] ? `, ${counts[l].waiting} wait` : ""}${MODES[mode] ?? ""}`];
        });
    }

    /** Moves cars and doors between two frames; true if any moved. */
    move(previous, next, share) {
        if (this.lifts.length === 0 || !next) return false;
        const cars = next.cars.slice(0, this.lifts.length).map((car, l) => {
            const was = previous.cars[l] ?? car, mix = (key) => (1 - share) * was[key] + share * car[key];
            return [mix("height"), mix("open")];
        });
        const state = JSON.stringify([cars, this.storeys.drawnDecks]);
        if (state === this.drawn) return false;
        this.drawn = state;
        cars.forEach((car, l) => this.place(this.lifts[l], ...car));
        return true;
    }

    place({ car, stops }, elevation, open) {
        const { storeys } = this, nearest = storeys.nearestStorey(elevation);
        car.visible = storeys.isShown(nearest);
        car.matrixWorld.makeTranslation(0, 0, storeys.drawnBetween(elevation));
        for (const { storey, way, leaves } of stops) {
            const share = storey === nearest ? 0.94 * open : 0;
            for (const { side, mesh } of leaves) {
                mesh.visible = storeys.isShown(storey);
                mesh.matrixWorld.makeTranslation(side * share * way[0], side * share * way[1], storeys.at[storey]);
            }
        }
    }
}
