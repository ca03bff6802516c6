/** The component of each scene. */
import type { FunctionComponent } from "preact";
import type { SceneName } from "../scenes";
import { AgreeScene } from "./AgreeScene";
import { CloudScene } from "./CloudScene";
import { DifferenceScene } from "./DifferenceScene";
import { ModelScene } from "./ModelScene";
import { PlanesScene } from "./PlanesScene";
import { RaceScene } from "./RaceScene";
import { StepScene } from "./StepScene";
import { TeacherScene } from "./TeacherScene";
import { YoursScene } from "./YoursScene";

export const SCENE_VIEWS: Record<SceneName, FunctionComponent> = {
  model: ModelScene,
  agree: AgreeScene,
  planes: PlanesScene,
  step: StepScene,
  cloud: CloudScene,
  difference: DifferenceScene,
  race: RaceScene,
  yours: YoursScene,
  teacher: TeacherScene,
};
