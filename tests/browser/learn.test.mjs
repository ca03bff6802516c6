/** Lessons that are looked at and handled: one model, two models, two planes; and what is around them. */
import assert from "node:assert/strict";
import { test } from "node:test";
import { shapevenn } from "./command.mjs";
import {
  accessibilityFaults,
  button,
  dropFiles,
  leave,
  shownMetrics,
  untilCompared,
  untilState,
  valueAt,
  withPage,
} from "./harness.mjs";
import { meshes } from "./meshes.mjs";

/** Links that stand still, with every setting that makes their numbers. */
const LINKS = {
  model: "scene=model&pair=stars-2&side=b&coefficients=1.5,-0.7",
  agree: "scene=agree&pair=stars-1&sigma=0.01&guess=0,2&shown=yes",
  planes:
    "scene=planes&tilt=35&shift=0.2&lift=0.3&sigma=0.2&side=b&coefficients=0.4,-1.1&turn=0.4,0.3",
  yours: "scene=yours",
  teacher: "scene=teacher",
};

async function open(page, url, link) {
  await leave(page, url);
  await page.goto(`${url}#v=1&page=learn&${link}`);
  await page.locator(".scene").waitFor();
  await untilState(page, "done");
}

/** The settings in the address, once they have been written down. */
const settled = (page, pattern) => page.waitForURL(pattern, { timeout: 5000 });
const setting = (page, key) => new URLSearchParams(new URL(page.url()).hash.slice(1)).get(key);
const board = (page) => page.getByRole("application");
const figure = async (page, metric) =>
  Number(await page.locator(`[data-metric="${metric}"]`).getAttribute("data-value"));

/** Drags from one place to another, as a hand would; `rest` is how long it stops on the way. */
async function drag(page, [x0, y0], [x1, y1], rest = 0) {
  await page.mouse.move(x0, y0);
  await page.mouse.down();
  await page.mouse.move((x0 + x1) / 2, (y0 + y1) / 2, { steps: 4 });
  await page.waitForTimeout(rest);
  await page.mouse.move(x1, y1, { steps: 4 });
  await page.mouse.up();
}

/** What the page looks like, in one number. */
const look = async (page) => (await page.locator(".scene").screenshot()).toString("base64");

/** Resolves once the page looks otherwise. */
async function untilOther(page, before) {
  for (let looks = 0; looks < 20; looks += 1) {
    if ((await look(page)) !== before) return;
    await page.waitForTimeout(100);
  }
  assert.fail("the picture stays as it was");
}

/** Whether the page ever looks the same a quarter of a second later: the first looks may be at its last letters. */
async function standsStill(page) {
  let before = await look(page);
  for (let looks = 0; looks < 3; looks += 1) {
    await page.waitForTimeout(250);
    const now = await look(page);
    if (now === before) return true;
    before = now;
  }
  return false;
}

test("a link opens a scene with its numbers, those of the command line, and the same again", async () => {
  await withPage({}, async ({ url, page }) => {
    for (const scene of ["model", "agree", "planes"]) {
      const link = LINKS[scene];
      await open(page, url, link);
      const shown = await shownMetrics(page);
      assert.ok(shown.length >= 3, `${scene}: ${shown.length} numbers`);
      const printed = JSON.parse(shapevenn("lesson", `page=learn&${link}`, "--json"));
      for (const [path, value] of shown) {
        assert.equal(value, valueAt(printed, path), `${scene}: ${path}`);
      }
      await open(page, url, link);
      assert.deepEqual(await shownMetrics(page), shown, `${scene} again`);
    }
  });
});

test("the point moves until it is stopped, and a link has where it was stopped", async () => {
  await withPage({}, async ({ url, page }) => {
    await open(page, url, "scene=model");
    const factor = page.locator(".equation-factor output").first();
    const before = await factor.textContent();
    await page.waitForFunction(
      (text) => document.querySelector(".equation-factor output").textContent !== text,
      before,
    );
    assert.equal(setting(page, "coefficients"), null, "nothing of it is in the link");
    await page.keyboard.press("Space");
    await settled(page, /coefficients=/);
    const [first] = setting(page, "coefficients").split(",");
    assert.equal((await factor.textContent()).replace("−", "-"), Math.abs(first).toFixed(2));
    await untilState(page, "done");
    const shown = await shownMetrics(page);
    const stopped = page.url();
    await leave(page, url);
    await page.goto(stopped);
    await untilState(page, "done");
    await page.waitForTimeout(300);
    assert.deepEqual(await shownMetrics(page), shown, "it opens where it was stopped");
    await button(page, "Run").waitFor();
  });
});

test("a point is moved by hand and by keys, and Back undoes it", async () => {
  await withPage({}, async ({ url, page }) => {
    await open(page, url, "scene=model&coefficients=1,1");
    const box = await board(page).boundingBox();
    const scale = Math.min(box.width, box.height) / 6.8;
    const at = (x, y) => [box.x + box.width / 2 + scale * x, box.y + box.height / 2 - scale * y];
    await drag(page, at(1, 1), at(-1, 0.5));
    await settled(page, /coefficients=-1,0.5/);
    await untilState(page, "done");
    assert.equal(await figure(page, "point.norm"), Math.hypot(1, 0.5));
    // Elsewhere there is nothing to hold.
    await drag(page, at(2.5, -2.5), at(2, 2));
    await page.keyboard.press("ArrowRight");
    await page.keyboard.press("Shift+ArrowUp");
    await settled(page, /coefficients=-0.9,1(&|$)/);
    await page.goBack();
    await settled(page, /coefficients=-1,0.5/);
    await untilState(page, "done");
    await page.waitForFunction(
      () => document.querySelector('[data-metric="point.logPrior"]').dataset.value === "-0.625",
    );
    await board(page).focus();
    await page.keyboard.press("Home");
    await settled(page, /coefficients=0,0/);
  });
});

test("guess first, then see", async () => {
  await withPage({}, async ({ url, page }) => {
    await open(page, url, "scene=agree");
    assert.equal(await page.locator("[data-metric]").count(), 0, "nothing is given away");
    await button(page, "top tip").click();
    await button(page, "lower right tip").click();
    await page.getByText("You say: top and lower right.").waitFor();
    await settled(page, /guess=0,3/);
    await button(page, "Reveal").click();
    await page.getByText(/^Partly right\. Both can move the top tip, and no other\./).waitFor();
    await settled(page, /shown=yes/);
    for (const [tip, moves] of [true, false, false, false, false].entries()) {
      const sd = await figure(page, `tips.${tip}.intersection`);
      assert.equal(sd > 0.1, moves, `tip ${tip} strays ${sd}`);
    }
    // With a large σ nearly everything is near.
    const slider = page.getByRole("slider");
    await slider.focus();
    await page.keyboard.press("End");
    await page.getByText(/still counts as near/).waitFor();
    await settled(page, /sigma=1/);
    await page.goBack();
    await page.goBack();
    await settled(page, /guess=0,3$/);
    await button(page, "Reveal").waitFor();
    await button(page, "lower right tip").click();
    await button(page, "Reveal").click();
    await page.getByText(/^Right\./).waitFor();
  });
});

test("planes are turned, tilted and lifted; the point stays in its plane", async () => {
  await withPage({}, async ({ url, page }) => {
    await open(page, url, "scene=planes&turn=-0.6,0.5&coefficients=0.5,0.5");
    assert.ok(Math.abs((await figure(page, "angles.1")) - 50) < 1e-9);
    const box = await board(page).boundingBox();
    // A corner, where there is no point.
    await drag(page, [box.x + 30, box.y + 30], [box.x + 132, box.y + 30], 700);
    await settled(page, /turn=-1.2,0.5/);
    assert.equal(setting(page, "coefficients"), "0.5,0.5", "the point is where it was");
    // However long the hand rested, it is one step.
    const turned = await look(page);
    await page.goBack();
    await settled(page, /turn=-0.6,0.5/);
    await untilOther(page, turned);
    // x in A, as it is seen: its plane is z = 0, its ellipse 1.5 by 1, and B’s middle is 0.4 beside its own.
    const seen = ([s, t]) => {
      const [cy, sy, sp] = [Math.cos(-0.6), Math.sin(-0.6), Math.sin(0.5)];
      const [x, y] = [1.5 * s - 0.2, t];
      const scale = Math.min(box.width / 1.25, box.height) / 7.7;
      return [
        box.x + box.width / 2 + scale * (-sy * x + cy * y),
        box.y + box.height / 2 + scale * sp * (cy * x + sy * y),
      ];
    };
    await drag(page, seen([0.5, 0.5]), seen([-0.5, 1]));
    await settled(page, /coefficients=-0\.(49|5|51),(0\.99|1|1\.01)/);
    await untilState(page, "done");
    const [, second] = setting(page, "coefficients").split(",").map(Number);
    const expected = Math.sin((50 * Math.PI) / 180) * second;
    await page.waitForFunction(
      (d) =>
        Math.abs(document.querySelector('[data-metric="point.distance"]').dataset.value - d) < 1e-9,
      expected,
    );
    await board(page).focus();
    await page.keyboard.press("l");
    await settled(page, /turn=-0.5,0.5/);
    await button(page, "Parallel").click();
    await page.getByText(/^Parallel planes never meet/).waitFor();
    await settled(page, /tilt=0/);
    await page.waitForFunction(
      () =>
        Math.abs(document.querySelector('[data-metric="point.distance"]').dataset.value - 0.8) <
        1e-9,
    );
    await page.getByRole("slider", { name: "B off A’s plane" }).press("Home");
    await settled(page, /lift=-1.5/);
    await page.keyboard.press("r");
    await settled(page, /scene=planes$/);
  });
});

test("nothing moves where motion is to be reduced", async () => {
  await withPage({ reducedMotion: "reduce" }, async ({ url, page }) => {
    for (const scene of ["model", "agree", "planes", "yours"]) {
      await open(page, url, `scene=${scene}`);
      assert.ok(await standsStill(page), `${scene} stays still`);
    }
    await open(page, url, "scene=planes");
    await button(page, "Run").click();
    assert.ok(!(await standsStill(page)), "unless somebody asks for it");
  });
});

test("without that, it moves from the first moment", async () => {
  await withPage({}, async ({ url, page }) => {
    for (const scene of ["model", "agree", "planes", "yours"]) {
      await open(page, url, `scene=${scene}`);
      assert.ok(!(await standsStill(page)), scene);
    }
  });
});

test("every scene is accessible, light and dark", async () => {
  for (const colorScheme of ["light", "dark"]) {
    await withPage({ colorScheme, reducedMotion: "reduce" }, async ({ url, page }) => {
      for (const [scene, link] of Object.entries(LINKS)) {
        await open(page, url, link);
        await page.evaluate(() => {
          for (const folded of document.querySelectorAll("details")) folded.open = true;
        });
        assert.deepEqual(await accessibilityFaults(page), [], `${scene}, ${colorScheme}`);
      }
      await open(page, url, "scene=agree");
      assert.deepEqual(await accessibilityFaults(page), [], `agree, ${colorScheme}, to guess`);
    });
  }
});

test("a phone needs no scrolling sideways, and neither do large letters", async () => {
  for (const viewport of [
    { width: 390, height: 844 },
    { width: 1440, height: 900 },
  ]) {
    await withPage({ viewport, reducedMotion: "reduce" }, async ({ url, page }) => {
      for (const [scene, link] of Object.entries(LINKS)) {
        for (const size of ["usual", "large"]) {
          await open(page, url, `${link}&size=${size}`);
          const over = await page.evaluate(() => {
            const main = document.querySelector("main");
            return Math.max(
              document.documentElement.scrollWidth - innerWidth,
              main.scrollWidth - main.clientWidth,
            );
          });
          assert.ok(over <= 0, `${scene}, ${viewport.width} px, ${size}: ${over} px too wide`);
        }
      }
    });
  }
});

test("a presenter goes from scene to scene by keys, and large letters stay", async () => {
  await withPage({}, async ({ url, page }) => {
    await open(page, url, "scene=model");
    await page.keyboard.press("p");
    await settled(page, /scene=model&size=large/);
    await page.keyboard.press("PageDown");
    await settled(page, /scene=agree&size=large/);
    await page.keyboard.press("ArrowRight");
    await settled(page, /scene=planes&size=large/);
    await untilState(page, "done");
    await page.keyboard.press("PageUp");
    await settled(page, /scene=agree/);
    for (const scene of ["planes", "agree", "model"]) {
      await page.goBack();
      await page.locator(`.learn[data-scene="${scene}"]`).waitFor();
    }
    await untilState(page, "done");
  });
});

test("answers are on paper, and folded again on the screen", async () => {
  await withPage({}, async ({ url, page }) => {
    await open(page, url, "scene=teacher");
    const unfolded = () => page.locator("details[open]").count();
    const questions = await page.locator("details").count();
    assert.ok(questions >= 12, `${questions} questions`);
    assert.equal(await unfolded(), 0);
    await page.evaluate(() => dispatchEvent(new Event("beforeprint")));
    assert.equal(await unfolded(), questions);
    await page.emulateMedia({ media: "print" });
    assert.equal(await page.getByRole("navigation", { name: "Scenes" }).isVisible(), false);
    assert.ok(await page.getByText("Four times as many").isVisible());
    await page.emulateMedia({ media: "screen" });
    await page.evaluate(() => dispatchEvent(new Event("afterprint")));
    assert.equal(await unfolded(), 0);
  });
});

test("the last scene leads to a comparison, and files that are dropped open one", async () => {
  await withPage({}, async ({ url, page }) => {
    await open(page, url, "scene=yours");
    await page.getByRole("link", { name: /^Male and female heads Which/ }).click();
    await page.getByRole("region", { name: "Model A" }).waitFor();
    await untilState(page, "done");
    await page.goBack();
    await page.getByRole("heading", { name: "Now with faces, and with yours" }).waitFor();
    await dropFiles(page, "body", [...meshes("female", 0, 7), ...meshes("male", 20, 6)]);
    await untilCompared(page, { a: "female", b: "male" });
  });
  await withPage({}, async ({ url, page }) => {
    // Where nothing was compared before.
    await open(page, url, "scene=yours");
    await dropFiles(page, "body", [...meshes("female", 0, 7), ...meshes("male", 20, 6)]);
    await untilCompared(page, { a: "female", b: "male" });
  });
});
