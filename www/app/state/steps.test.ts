import assert from "node:assert/strict";
import { test } from "node:test";
import { Steps } from "./steps";

/** A browser's history that arrives when it is told to. */
class Entries {
  list: unknown[] = [null];
  place = 0;
  journeys: number[] = [];
  get state() {
    return this.list[this.place];
  }
  pushState(state: unknown) {
    this.place += 1;
    this.list = [...this.list.slice(0, this.place), state];
  }
  replaceState(state: unknown) {
    this.list[this.place] = state;
  }
  go(by?: number) {
    this.journeys.push(by ?? 0);
  }
  travel(): unknown {
    this.place += this.journeys.at(-1) ?? 0;
    return this.state;
  }
}

function begin() {
  const entries = new Entries();
  const steps = new Steps<string>(entries, 7);
  steps.begin("first");
  const can = () => [steps.undoable.value, steps.redoable.value];
  return { entries, steps, can };
}

test("undo goes back one step and redo forth, each only where there is one", () => {
  const { entries, steps, can } = begin();
  assert.deepEqual(can(), [false, false]);
  steps.undo();
  steps.redo();
  assert.deepEqual(entries.journeys, [], "there is nowhere to go");
  steps.push("second", "#b");
  assert.deepEqual(can(), [true, false]);
  steps.undo();
  assert.equal(steps.arrive(entries.travel()), "first");
  assert.deepEqual(can(), [false, true]);
  steps.redo();
  assert.equal(steps.arrive(entries.travel()), "second");
  assert.deepEqual(entries.journeys, [-1, 1]);
});

test("a step after an undo leaves nothing to redo", () => {
  const { entries, steps, can } = begin();
  steps.push("second", "#b");
  steps.undo();
  steps.arrive(entries.travel());
  steps.push("other", "#c");
  assert.deepEqual(can(), [true, false]);
  assert.equal(entries.list.length, 2);
});

test("however fast undo is pressed, it neither loses a step nor leaves the page", () => {
  const { entries, steps } = begin();
  steps.push("second", "#b");
  steps.push("third", "#c");
  for (let presses = 0; presses < 5; presses += 1) steps.undo();
  assert.deepEqual(entries.journeys, [-1], "one journey at a time");
  assert.equal(steps.arrive(entries.travel()), "second");
  assert.deepEqual(entries.journeys, [-1, -1], "the others go as far as there are steps");
  assert.equal(steps.arrive(entries.travel()), "first");
  assert.equal(steps.undoable.value, false);
});

test("what joins a step is undone with it", () => {
  const { entries, steps } = begin();
  steps.push("models", "#b");
  steps.join("models and settings", "#c");
  assert.equal(entries.list.length, 2);
  steps.undo();
  assert.equal(steps.arrive(entries.travel()), "first");
  steps.redo();
  assert.equal(steps.arrive(entries.travel()), "models and settings");
});

test("numbers from before the page was loaded anew mean nothing", () => {
  const { steps, can } = begin();
  steps.push("second", "#b");
  assert.equal(steps.arrive({ life: 6, step: 1 }), null);
  assert.deepEqual(can(), [false, true]);
});

test("an address that somebody types is a step of its own, which the address alone describes", () => {
  const { entries, steps, can } = begin();
  steps.push("second", "#b");
  entries.place += 1;
  entries.list[entries.place] = null;
  assert.equal(steps.arrive(null), null);
  assert.deepEqual(entries.state, { life: 7, step: 2 });
  assert.deepEqual(can(), [true, false]);
});
