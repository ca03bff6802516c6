import type { ComponentChildren } from "preact";

function Icon({ children }: { children: ComponentChildren }) {
  return (
    <svg class="icon" viewBox="0 0 20 20" aria-hidden="true">
      {children}
    </svg>
  );
}

export const ShareIcon = () => (
  <Icon>
    <path d="M10 12.500v-9M6.500 7 10 3.500 13.500 7M6 9.500H4.500v7h11v-7H14" />
  </Icon>
);

export const SunIcon = () => (
  <Icon>
    <circle cx="10" cy="10" r="3.2" />
    <path d="M10 2.5v1.8M10 15.7v1.8M2.5 10h1.8M15.7 10h1.8M4.7 4.7l1.3 1.3M14 14l1.3 1.3M15.3 4.7 14 6M6 14l-1.3 1.3" />
  </Icon>
);

export const MoonIcon = () => (
  <Icon>
    <path d="M16 11.8A6.5 6.5 0 0 1 8.2 4a6.5 6.5 0 1 0 7.8 7.8Z" />
  </Icon>
);

export const CloseIcon = () => (
  <Icon>
    <path d="m5.5 5.5 9 9M14.5 5.5l-9 9" />
  </Icon>
);

export const ExpandIcon = () => (
  <Icon>
    <path d="M11.5 4h4.5v4.5M8.500 16H4v-4.5M16 4l-5 5M4 16l5-5" />
  </Icon>
);

export const BackIcon = () => (
  <Icon>
    <path d="M3.500 3.500h5.500v5.500h-5.500ZM11 3.500h5.500v5.500H11ZM3.500 11h5.500v5.500h-5.500ZM11 11h5.500v5.500H11Z" />
  </Icon>
);

export const DownloadIcon = () => (
  <Icon>
    <path d="M10 3.500v9M6.500 9.500 10 13l3.500-3.500M4 16.500h12" />
  </Icon>
);

export const UndoIcon = () => (
  <Icon>
    <path d="M7 4 3.5 7.500 7 11M4 7.500h7.500a4.250 4.250 0 0 1 0 8.500H8" />
  </Icon>
);

export const RedoIcon = () => (
  <Icon>
    <path d="m13 4 3.500 3.500L13 11M16 7.500H8.500a4.250 4.250 0 0 0 0 8.500H12" />
  </Icon>
);

export const PlayIcon = () => (
  <Icon>
    <path d="M7 4.500v11l8.500-5.500Z" />
  </Icon>
);

export const StopIcon = () => (
  <Icon>
    <path d="M5.500 5.500h9v9h-9Z" />
  </Icon>
);
