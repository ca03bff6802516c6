import { useDone } from "../asked";
import { TRY_OUT, type TryOut } from "./yours/questions";
import { VennStars } from "./yours/VennStars";
import "./yours.css";

/** From stars to faces, and to whatever models somebody has. */
export function YoursScene() {
  useDone(true);
  return (
    <>
      <p class="lead">
        Nothing in the method knows about stars. Two models of the same points, whether of faces,
        bodies, bones or organs, are compared in just the same way, and how you read the answer is
        how you read it here.
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
            href="#v=1&demo=heads-expression"
            name="Identity and expression"
            says="Two models of the same face that should share next to nothing."
          />
          <Door
            href="#v=1"
            name="Your own models"
            says="Drop two files, or two folders of meshes, anywhere on this page. They stay on your computer."
          />
          <Door
            href="#v=1&page=gallery"
            name="The gallery"
            says="Comparisons worth a look, each with what there is to see."
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
