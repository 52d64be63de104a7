// Colours: Okabe and Ito's; those of the levels come with the data and are the same as in the figures.

const INK = '#1a1a1a';
const GREY = '#767676';
const SKY_BLUE = '#56b4e9';
const BEAM = '#12a812';
const SKY = '#eef3f8';
const GROUND = '#e4e6e1';
const GRID = '#b9bfb8';

/** The colour of a level from 1 to 5; ink where it is not known. */
function levelColour(level) {
    return DATA.colours[level - 1] || INK;
}
