import { render } from "preact";
import { boot } from "./boot";
import { acceptDrops } from "./drop";
import { App } from "./views/App";
import "../styles/page.css";
import "../styles/stage.css";
import "../styles/panels.css";
import "../styles/pair.css";
import "../styles/explore.css";
import "../styles/maps.css";
import "../styles/several.css";
import "../styles/charts.css";
import "../styles/share.css";
import "../styles/embed.css";

acceptDrops();
const root = document.getElementById("app");
if (root) render(<App />, root);
void boot();
