import { render } from "preact";
import { App } from "./shell/App";
import { boot } from "./shell/boot";
import { acceptDrops } from "./shell/drop";
import "./shell/page.css";
import "./stage/stage.css";
import "./panels/panels.css";
import "./panels/pair.css";
import "./tabs/explore/explore.css";
import "./stage/maps.css";
import "./tabs/models/models.css";
import "./ui/charts.css";
import "./share/share.css";
import "./shell/embed.css";

acceptDrops();
const root = document.getElementById("app");
if (root) render(<App />, root);
void boot();
