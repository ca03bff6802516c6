import assert from "node:assert/strict";
import { test } from "node:test";
import { DEMO_GROUPS, DEMO_MODELS, demoOf, findDemo } from "./demos";

test("every example is found by its name and by its two models, A first", () => {
  const demos = DEMO_GROUPS.flatMap((group) => group.demos);
  assert.equal(demos.length, 10);
  for (const demo of demos) {
    assert.equal(findDemo(demo.id), demo, demo.id);
    assert.equal(demoOf(demo.a, demo.b), demo, demo.id);
    assert.equal(demoOf(demo.b, demo.a), undefined, `${demo.id}, turned round`);
  }
  assert.equal(new Set(DEMO_MODELS).size, 2 * demos.length, "no model is in two of them");
});
