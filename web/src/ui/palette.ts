// Colours of curves, which can be told apart on light and on dark ground, and dashes.
export const plotColours = ["#3b82d6", "#e07b39", "#2f9e6e", "#b65fb0", "#c9a21f", "#6d68cf", "#2aa3b3", "#d2574d"];
export const runDashes: number[][] = [[], [6, 4], [2, 3], [8, 3, 2, 3]];
