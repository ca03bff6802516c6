import { useEffect, useRef } from "preact/hooks";
import { writeLesson } from "../link";
import { standardValues } from "../params";
import { SCENE_PARAMS, SCENES, type SceneName, type SceneTitle, titleOf } from "../scenes";
import { goTo, large, scene } from "../state";

/** Link to a scene. */
function SceneLink({
  name,
  class: kind,
  children,
}: {
  name: SceneName;
  class?: string;
  children: preact.ComponentChildren;
}) {
  const fresh = { scene: name, values: standardValues(SCENE_PARAMS[name]), large: large.value };
  const pairs = writeLesson(fresh).map(([key, value]) => `&${key}=${value}`);
  return (
    <a
      class={kind}
      href={`#v=1&page=learn${pairs.join("")}`}
      aria-current={scene.value === name ? "step" : undefined}
      onClick={(event) => {
        if (event.ctrlKey || event.metaKey || event.shiftKey) return;
        event.preventDefault();
        goTo(name);
      }}
    >
      {children}
    </a>
  );
}

export function SceneList({
  scenes,
  teacher,
}: {
  scenes: readonly SceneTitle[];
  teacher: SceneTitle;
}) {
  const list = useRef<HTMLElement>(null);
  const shown = scene.value;
  // On narrow screens the list scrolls sideways.
  useEffect(() => {
    const current = list.current?.querySelector<HTMLElement>("[aria-current]");
    if (list.current && current) {
      list.current.scrollLeft =
        current.offsetLeft - list.current.clientWidth / 2 + current.offsetWidth / 2;
    }
  }, [shown]);
  return (
    <nav class="scene-list" aria-label="Scenes" ref={list}>
      <ol>
        {scenes.map(({ name, short }, i) => (
          <li key={name}>
            <SceneLink name={name}>
              <span class="scene-number">{i + 1}</span>
              {short}
            </SceneLink>
          </li>
        ))}
      </ol>
      <SceneLink name={teacher.name} class="scene-teacher">
        {teacher.short}
      </SceneLink>
    </nav>
  );
}

/** Links to the previous and the next scene. */
export function StepAlong() {
  const { before, after } = neighbours(scene.value);
  return (
    <nav class="scene-along" aria-label="Previous and next scene">
      {before && <SceneLink name={before}>← {titleOf(before).short}</SceneLink>}
      {after && (
        <SceneLink name={after} class="scene-next">
          {titleOf(after).title} →
        </SceneLink>
      )}
    </nav>
  );
}

export function neighbours(name: SceneName): { before: SceneName | null; after: SceneName | null } {
  const index = SCENES.findIndex((one) => one.name === name);
  if (index < 0) return { before: SCENES.at(-1)?.name ?? null, after: null };
  return { before: SCENES[index - 1]?.name ?? null, after: SCENES[index + 1]?.name ?? null };
}
