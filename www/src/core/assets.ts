// Files beside the page: the compiled modules of the core, and the script of the worker. For the one-file page the build
// uses assets.inline.ts instead.
import figuresUrl from '../../pkg-figures/figures_bg.wasm?url'
import laboratoryUrl from '../../pkg/ringroad_bg.wasm?url'

const urls = { laboratory: laboratoryUrl, figures: figuresUrl }

export const wasmBytes = async (module: keyof typeof urls): Promise<ArrayBuffer> => {
  const url = urls[module]
  const response = await fetch(url)
  if (!response.ok) throw new Error(`${url}: ${response.status} ${response.statusText}`)
  return response.arrayBuffer()
}

/** A worker that runs the page's own script. */
export const startWorker = (): Worker => new Worker(import.meta.url, { type: 'module' })

/** The second module (the paper's figures, the export of tables), loaded when it is first used. */
export const figures = () => import('./figures')
