// The language of the paper's figures; see index.ts for that of everything else.
import { type FiguresDictionary, enFigures } from './en_figures'

export const figuresText: FiguresDictionary = enFigures
