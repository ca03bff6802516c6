import { cancel, start } from "../comparison/run";
import {
  LOOKS_WELL,
  liveBelief,
  secondsLeft,
  settingsSentence,
  stageName,
} from "../comparison/words";
import {
  currentKey,
  engine,
  failedKey,
  inspection,
  outOfDate,
  pageState,
  result,
  run,
  unit,
} from "../state/state";
import { duration, number, percent } from "../text/format";
import { Notices } from "../ui/Notices";

/** Starts or cancels a run and shows its progress. */
export function RunPanel() {
  return (
    <section class="run" aria-label="Run">
      {run.value ? <Running /> : <Idle />}
      <Notices place="run" />
      <Build />
    </section>
  );
}

function Idle() {
  const held = result.value;
  const cannot = inspection.value?.problem != null;
  const canRun = pageState.value !== "loading" && engine.value !== null && !cannot;
  const label = held === null ? "Compare" : held.stored ? "Run it live" : "Run again";
  return (
    <>
      <div class="run-row">
        <button type="button" class="primary" disabled={!canRun} onClick={() => void start()}>
          {label}
        </button>
        <p class="run-state">{stateSentence()}</p>
      </div>
      {held && (
        <p class="settings-line">
          {outOfDate.value && "Shown: "}
          {settingsSentence(held.report)}
        </p>
      )}
    </>
  );
}

function stateSentence(): string {
  const held = result.value;
  if (pageState.value === "loading") return "Opening the models…";
  if (inspection.value?.problem) return "These two models cannot be compared as they stand.";
  if (held === null) return "Nothing compared yet.";
  if (outOfDate.value && failedKey.value === currentKey.value) {
    return "This run gave no result. The previous one is still shown.";
  }
  if (outOfDate.value) return "Out of date: models or settings have changed.";
  if (held.stored) return "Stored result, computed by this version of the engine.";
  const took = duration(held.report.seconds.total);
  return held.cancelled
    ? `Cancelled after ${took}; the draws so far are kept.`
    : `Finished in ${took}.`;
}

function Running() {
  const state = run.value;
  if (!state) return null;
  const { progress, seconds, cancelling } = state;
  const fraction = progress?.fraction ?? 0;
  const left = secondsLeft(fraction, seconds);
  const belief = progress ? liveBelief(progress) : "waiting for the first draws";
  return (
    <>
      <div class="run-row">
        <button type="button" class="primary cancel" disabled={cancelling} onClick={cancel}>
          {cancelling ? "Stopping…" : "Cancel"}
        </button>
        <p class="run-state">
          <strong class="num">{Math.round(100 * fraction)}&#8239;%</strong>{" "}
          {stageName(progress?.stage ?? "prepare")}
          <span class="dim">{left === null ? "" : ` · ${duration(left)} left`}</span>
        </p>
      </div>
      <progress class="bar" value={fraction} max={1} aria-label="Progress of the run" />
      <dl class="live">
        <div>
          <dt>σ</dt>
          <dd>{progress?.sigma ? `${number(progress.sigma)} ${unit.value}` : "–"}</dd>
        </div>
        <div>
          <dt>acceptance</dt>
          <dd>{progress?.acceptance == null ? "–" : percent(progress.acceptance)}</dd>
        </div>
        <div>
          <dt>R-hat</dt>
          <dd>{progress?.rHatMax?.toFixed(3) ?? "–"}</dd>
        </div>
        <div>
          <dt>ESS</dt>
          <dd>{progress?.essBulkMin == null ? "–" : number(progress.essBulkMin)}</dd>
        </div>
      </dl>
      <p class="belief" data-converged={belief === LOOKS_WELL}>
        {belief}
      </p>
    </>
  );
}

function Build() {
  const info = engine.value;
  if (!info) return <p class="build">Engine starting…</p>;
  const how =
    info.build === "threads"
      ? `${info.threads} thread${info.threads === 1 ? "" : "s"}`
      : "one thread";
  return (
    <p class="build" data-build={info.build}>
      Engine {info.version} · {how}
    </p>
  );
}
