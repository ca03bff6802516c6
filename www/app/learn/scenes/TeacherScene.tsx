import { useEffect, useRef } from "preact/hooks";
import { useDone } from "../asked";
import { PRESENTER_KEYS, toggleFullScreen, toggleLarge } from "../keys";
import { titleOf } from "../scenes";
import { large } from "../state";
import { beginnings, GOALS, PLANS, type Plan } from "./teacher/plans";
import { openForPrint } from "./teacher/print";
import { QUESTIONS } from "./teacher/questions";
import { Usage } from "./teacher/Usage";
import "./teacher.css";

/** Page for teachers: goals, plans, questions with answers, keys, and how to use the lessons elsewhere. */
export function TeacherScene() {
  useDone(true);
  const page = useRef<HTMLDivElement>(null);
  useEffect(() => (page.current ? openForPrint(page.current) : undefined), []);
  return (
    <div class="teacher" ref={page}>
      <p class="lead">
        Eight scenes, each a link; no account, nothing to install. All numbers are computed in this
        page by the same engine that compares real models.
      </p>
      <div class="teacher-tools">
        <button type="button" aria-pressed={large.value} onClick={toggleLarge}>
          Large letters
        </button>
        <button type="button" onClick={toggleFullScreen}>
          Full screen
        </button>
        <button type="button" onClick={() => print()}>
          Print, with answers
        </button>
      </div>

      <section aria-labelledby="teacher-goals">
        <h3 id="teacher-goals">Goals: students can …</h3>
        <ol class="teacher-goals">
          {GOALS.map(({ scene, can }) => (
            <li key={scene}>
              <a href={linkOf(scene)}>{titleOf(scene).short}</a>: {can}.
            </li>
          ))}
        </ol>
      </section>

      {PLANS.map((plan) => (
        <Schedule key={plan.name} plan={plan} />
      ))}

      <section aria-labelledby="teacher-questions">
        <h3 id="teacher-questions">Questions, with answers</h3>
        <ol class="teacher-questions">
          {QUESTIONS.map(({ scene, link, ask, answer }, i) => (
            <li key={i}>
              <details class="ask">
                <summary>
                  <span>{ask}</span>
                </summary>
                <p>{answer}</p>
                <p>
                  <a href={linkOf(scene, link)}>Show it: {titleOf(scene).title}</a>
                </p>
              </details>
            </li>
          ))}
        </ol>
      </section>

      <section aria-labelledby="teacher-keys">
        <h3 id="teacher-keys">Keys while presenting</h3>
        <p>A remote control that turns pages goes from scene to scene.</p>
        <dl class="teacher-keys">
          {PRESENTER_KEYS.map(([keys, does]) => (
            <div key={keys}>
              <dt>
                <kbd>{keys}</kbd>
              </dt>
              <dd>{does}</dd>
            </div>
          ))}
        </dl>
      </section>
      <Usage />
    </div>
  );
}

function linkOf(scene: string, rest = ""): string {
  return `#v=1&page=learn&scene=${scene}${rest === "" ? "" : `&${rest}`}`;
}

function Schedule({ plan }: { plan: Plan }) {
  const begins = beginnings(plan);
  return (
    <section class="teacher-plan">
      <h3>{plan.name}</h3>
      <div class="teacher-table">
        <table>
          <thead>
            <tr>
              <th scope="col">Minute</th>
              <th scope="col">Scene</th>
              <th scope="col">What to do</th>
              <th scope="col">Question</th>
            </tr>
          </thead>
          <tbody>
            {plan.parts.map(({ scene, minutes, act, question }, i) => (
              <tr key={scene}>
                <td class="num" data-label="Minute">
                  {begins[i]}–{(begins[i] ?? 0) + minutes}
                </td>
                <th scope="row">
                  <a href={linkOf(scene)}>{titleOf(scene).short}</a>
                </th>
                <td>{act}</td>
                <td>{question}</td>
              </tr>
            ))}
          </tbody>
        </table>
      </div>
    </section>
  );
}
