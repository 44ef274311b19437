// What lies beside the page: the compiled modules of the core, and the script for the worker. In the one-file page the
// build takes assets.inline.ts instead.
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

/** The paper's figures are a module of their own, which the laboratory does without. */
export const figures = () => import('./figures')
