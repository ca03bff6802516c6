import { embedded } from "../state/state";
import { isDark } from "../state/theme";
import { Notices } from "../ui/Notices";
import { EXHIBIT_GROUPS, type Exhibit, linkTo } from "./exhibits";
import "./gallery.css";

/** Gallery of example comparisons, each with a picture and a sentence. */
export function Gallery() {
  return (
    <main class="gallery">
      <Notices place="link" />
      <header>
        <h2>Gallery</h2>
        <p class="gallery-lead">
          Comparisons of the models that come with this page. Each opens as a link, ready to be
          turned, changed and shared.
        </p>
      </header>
      {EXHIBIT_GROUPS.map(({ title, exhibits }) => (
        <section key={title} aria-label={title}>
          <h3>{title}</h3>
          <ul>
            {exhibits.map((exhibit) => (
              <li key={exhibit.name}>
                <Card exhibit={exhibit} />
              </li>
            ))}
          </ul>
        </section>
      ))}
    </main>
  );
}

function Card({ exhibit }: { exhibit: Exhibit }) {
  const { name, title, see } = exhibit;
  return (
    // In a frame the comparison opens outside of it, since a frame has no Back button.
    <a
      class="exhibit"
      href={linkTo(exhibit)}
      target={embedded.value ? "_blank" : undefined}
      rel="noopener"
    >
      <img
        src={`gallery/${name}-${isDark() ? "dark" : "light"}.webp`}
        alt=""
        width={640}
        height={400}
        loading="lazy"
      />
      <h4>{title}</h4>
      <p>{see}</p>
    </a>
  );
}
