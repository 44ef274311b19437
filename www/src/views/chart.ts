// A line chart over time, the same window as the map's.
import uPlot from 'uplot'
import 'uplot/dist/uPlot.min.css'
import { el, style } from '../dom'

export interface Line {
  readonly label: string
  readonly colour: string
  readonly dash?: number[]
  readonly width?: number
}
export interface Chart {
  readonly element: HTMLElement
  /** Columns: times first. `low`, `high`: what the vertical axis shows at least. */
  show(columns: (number | null)[][], window: [number, number], low: number, high: number): void
  /** Draws with the colours of the page as it is now. */
  restyle(lines: readonly Line[]): void
}

export function chart(label: string): Chart {
  const element = el('div', { class: 'chart', role: 'img', 'aria-label': label })
  let plot: uPlot | undefined
  let lines: readonly Line[] = []
  let data: uPlot.AlignedData = [[]]
  let range: [number, number] = [0, 300]
  let ends: [number, number] = [0, 1]
  const build = () => {
    plot?.destroy()
    plot = undefined
    const { clientWidth: width, clientHeight: height } = element
    if (width < 40 || height < 40 || lines.length === 0) return
    const font = '13px system-ui, sans-serif'
    const axis = { stroke: style('--soft'), font, grid: { stroke: style('--track'), width: 1 }, ticks: { show: false } }
    plot = new uPlot(
      {
        width,
        height,
        legend: { show: false },
        cursor: { show: false },
        padding: [8, 14, 0, 0],
        scales: { x: { time: false, range: () => range }, y: { range: () => ends } },
        axes: [
          { ...axis, space: 70, size: 26, gap: 3, values: (_u, values) => values.map(String) },
          { ...axis, space: 34, size: 46, gap: 5 },
        ],
        series: [
          {},
          ...lines.map(line => ({
            label: line.label,
            stroke: line.colour,
            width: line.width ?? 1.75,
            points: { show: false },
            ...(line.dash ? { dash: line.dash } : {}),
          })),
        ],
      },
      data.length === lines.length + 1 ? data : [[], ...lines.map(() => [])],
      element,
    )
  }
  new ResizeObserver(() => {
    if (!plot) return build()
    plot.setSize({ width: element.clientWidth, height: element.clientHeight })
  }).observe(element)
  return {
    element,
    show(columns, window, low, high) {
      data = columns as uPlot.AlignedData
      range = window
      ends = [low, high]
      if (element.clientWidth === 0) return
      if (plot) plot.setData(data)
      else build()
    },
    restyle(next) {
      lines = next
      build()
    },
  }
}

/** Names of the lines, each with a piece of it. */
export const keys = (lines: readonly Line[]): HTMLElement =>
  el(
    'div',
    { class: 'keys' },
    ...lines.map(line => el('span', { style: `--colour:${line.colour};--dash:${line.dash ? 'dashed' : 'solid'}` }, line.label)),
  )

/** Line colours that colour-blind eyes tell apart (after Okabe and Ito), for either ground. */
export const palette = (dark: boolean): readonly string[] =>
  dark ? ['#7cc4f5', '#f0a941', '#4fd0a5', '#f08bc1', '#e6e04e'] : ['#0064a6', '#b45f00', '#007a57', '#b13a80', '#5a4fb0']
