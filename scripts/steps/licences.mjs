/** Says whether the licence expression of a crate is met by a list of licences. */

/** The entries of `allow` in deny.toml. Read by hand: Node reads no TOML, and this list is all that is wanted of it. */
export function allowedLicences(toml) {
  const [, list] = /^\[licenses\][^[]*?^allow = \[([\s\S]*?)^\]/m.exec(toml) ?? [];
  if (list === undefined) {
    throw new Error(
      "Expected a list `allow` in the section [licenses] of deny.toml, found none. Give it back its list of licences.",
    );
  }
  return [...list.replace(/#.*$/gm, "").matchAll(/"([^"]+)"/g)].map(([, name]) => name);
}

/**
 * Whether one may use something under `expression` with `allowed` alone. It is an SPDX expression, where AND binds more
 * tightly than OR; a slash is OR, as crates wrote it once. What is not an expression is met by nothing.
 */
export function isMet(expression, allowed) {
  if (typeof expression !== "string") return false;
  const words = expression.replaceAll("/", " OR ").match(/[()]|[^\s()]+/g) ?? [];
  let place = 0;
  let sound = true;
  const take = (word) => {
    const is = words[place] === word;
    if (is) place += 1;
    return is;
  };
  const licence = () => {
    const name = words[place] ?? ")";
    sound &&= !["(", ")", "AND", "OR", "WITH"].includes(name);
    place += 1;
    return name;
  };
  const term = () => {
    if (take("(")) {
      const met = any();
      sound &&= take(")");
      return met;
    }
    const name = licence();
    return allowed.includes(take("WITH") ? `${name} WITH ${licence()}` : name);
  };
  // Both sides are read in any case, hence no && and ||.
  const all = () => {
    let met = term();
    while (take("AND")) met = [term(), met].every(Boolean);
    return met;
  };
  const any = () => {
    let met = all();
    while (take("OR")) met = [all(), met].some(Boolean);
    return met;
  };
  const met = any();
  return met && sound && place === words.length;
}
