// Imported before the styles of the scenes, which override it.
import "../learn/learn.css";
import { useEffect, useRef } from "preact/hooks";
import { useHands } from "../learn/hands";
import { useKeys } from "../learn/keys";
import { SceneList, StepAlong } from "../learn/parts/SceneList";
import { SCENES, TEACHER, titleOf } from "../learn/scenes";
import { SCENE_VIEWS } from "../learn/scenes/index";
import { large, resets, scene } from "../learn/state";
import { sharedAddress } from "../link/history";
import { embedded } from "../state/state";
import { Notices } from "../ui/Notices";

/** The page Learn: one scene of the lessons at a time. */
export function Learn() {
  const top = useRef<HTMLElement>(null);
  const name = scene.value;
  useKeys();
  useHands();
  // A new scene is shown from its top.
  useEffect(() => {
    top.current?.scrollTo(0, 0);
  }, [name]);
  useEffect(() => {
    document.documentElement.dataset.letters = large.value ? "large" : "usual";
    return () => delete document.documentElement.dataset.letters;
  }, [large.value]);
  const framed = embedded.value;
  const View = SCENE_VIEWS[name];
  const { title } = titleOf(name);
  const index = SCENES.findIndex((one) => one.name === name);
  return (
    <main class="learn" ref={top} data-scene={name} data-framed={framed}>
      {!framed && <SceneList scenes={SCENES} teacher={TEACHER} />}
      <article class="scene" aria-labelledby="scene-title">
        <Notices place="page" />
        <Notices place="link" />
        <header class="scene-head">
          {index >= 0 && (
            <p class="scene-place">
              {index + 1} of {SCENES.length}
            </p>
          )}
          <h2 id="scene-title">{title}</h2>
        </header>
        <View key={`${name} ${resets.value}`} />
        {framed ? <WayOut /> : <StepAlong />}
      </article>
    </main>
  );
}

/** Link from a frame to the whole page. */
function WayOut() {
  return (
    <footer class="scene-along">
      <a class="scene-next" href={sharedAddress()} target="_blank" rel="noopener">
        Open in Shapevenn
      </a>
    </footer>
  );
}
