// Okabe and Ito's colour-blind safe palette; app/model/colours.py has the same names and values for the plots.
export const colours = {
  theta: "#0072B2",
  normal: "#009E73",
  friction: "#D55E00",
  omega: "#CC79A7",
  momentum: "#E69F00",
  jellett: "#56B4E9",
  energy: "#8C6D00",
};
