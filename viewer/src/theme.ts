/** Colours: those of view.css, light or dark, as the drawing surfaces need them. */

export interface Theme {
  floor: string;
  grid: string;
  wall: string;
  rock: string;
  rockEdge: string;
  ink: string;
  faint: string;
  robot: string;
  lamp: string;
  ray: string;
  crash: string;
  late: string;
  glow: string;
  page: string;
  skills: string[];
}

const CHOICE = "mind-theme";

/** The colours that hold now. */
export function theme(): Theme {
  const style = getComputedStyle(document.documentElement);
  const colour = (name: string) => style.getPropertyValue(`--${name}`).trim();
  return {
    floor: colour("floor"),
    grid: colour("grid"),
    wall: colour("wall"),
    rock: colour("rock"),
    rockEdge: colour("rock-edge"),
    ink: colour("ink"),
    faint: colour("faint"),
    robot: colour("robot"),
    lamp: colour("lamp"),
    ray: colour("ray"),
    crash: colour("crash"),
    late: colour("late"),
    glow: colour("glow"),
    page: colour("page"),
    skills: colour("skills").split(/\s+/),
  };
}

/** A switch from light to dark and back; without a choice it is the system's. */
export function themeSwitch(button: HTMLElement, changed: () => void): void {
  const dark = matchMedia("(prefers-color-scheme: dark)");
  const set = (choice: string) => {
    document.documentElement.dataset.theme = choice;
    button.setAttribute("aria-pressed", String(choice === "dark"));
    changed();
  };
  const chosen = () => remembered() ?? (dark.matches ? "dark" : "light");
  dark.addEventListener("change", () => set(chosen()));
  button.addEventListener("click", () => {
    const choice = document.documentElement.dataset.theme === "dark" ? "light" : "dark";
    remember(choice);
    set(choice);
  });
  set(chosen());
}

// A page from a file may have no storage; then the choice holds until it is closed.
function remembered(): string | null {
  try {
    return localStorage.getItem(CHOICE);
  } catch {
    return null;
  }
}

function remember(choice: string): void {
  try {
    localStorage.setItem(CHOICE, choice);
  } catch {
    return;
  }
}
