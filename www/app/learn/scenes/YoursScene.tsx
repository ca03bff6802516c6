import { ENGINE } from "../../state/settings";
import { useDone } from "../asked";
import { TRY_OUT, type TryOut } from "./yours/questions";
import { VennStars } from "./yours/VennStars";
import "./yours.css";

/** Last scene: links to comparisons of heads and of the visitor's own models, with questions. */
export function YoursScene() {
  useDone(true);
  return (
    <>
      <p class="lead">
        The method is not limited to stars. Two models of the same points, of faces, bodies, bones
        or organs, are compared in the same way, and the results are read in the same way.
      </p>
      <div class="yours-doors">
        <VennStars />
        <nav class="yours-links" aria-label="Comparisons">
          <Door
            href="#v=1&demo=heads-sex&sigma=1"
            name="Male and female heads"
            says="Which heads can both models make, and which only one of them?"
          />
          <Door
            href={`#v=1&engine=${ENGINE}&demo=heads-expression`}
            name="Identity and expression"
            says="Two models of the same face that should have little in common."
          />
          <Door
            href="#v=1"
            name="Your own models"
            says="Drop two files, or two folders of meshes, anywhere on this page. They stay on your computer."
          />
          <Door
            href="#v=1&page=gallery"
            name="The gallery"
            says="Example comparisons, each with an explanation."
          />
        </nav>
      </div>
      <section class="yours-questions" aria-labelledby="yours-title">
        <h3 id="yours-title">Three questions to try</h3>
        <ol>
          {TRY_OUT.map((question) => (
            <Question key={question.ask} {...question} />
          ))}
        </ol>
      </section>
    </>
  );
}

function Door({ href, name, says }: { href: string; name: string; says: string }) {
  return (
    <a class="yours-door" href={href}>
      <b>{name}</b>
      <span>{says}</span>
    </a>
  );
}

function Question({ ask, href, link, answer }: TryOut) {
  return (
    <li>
      <p>{ask}</p>
      <p>
        <a href={href}>{link}</a>
      </p>
      <details class="ask">
        <summary>What to see</summary>
        <p>{answer}</p>
      </details>
    </li>
  );
}
