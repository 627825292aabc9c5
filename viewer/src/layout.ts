/** Where nodes stand and edges run: laid out by dagre; so many that this would take seconds, in plain layers. */

import { graphlib, layout as dagreLayout } from "@dagrejs/dagre";

export interface Size {
  width: number;
  height: number;
}

export interface Placed {
  centres: Map<number, { x: number; y: number }>;
  lines: Map<number, { x: number; y: number }[]>; // by edge
  width: number;
  height: number;
}

type Ends = (edge: number) => { from: number; to: number };

const DAGRE_NODES_MAX = 300;
const NODE_GAP = 18;
const LAYER_GAP = 56;
const WIDE = 2; // so many times wider than where it is seen: then it runs from left to right, if that fits better

/** Places for nodes of these sizes, for a pane of such a width by its height. */
export function place(nodes: number[], edges: number[], ends: Ends, size: (node: number) => Size, aspect: number): Placed {
  if (nodes.length > DAGRE_NODES_MAX) return inLayers(nodes, edges, ends, size, aspect);
  const down = byDagre(nodes, edges, ends, size, "TB");
  if (down.width / down.height < WIDE * aspect) return down;
  const across = byDagre(nodes, edges, ends, size, "LR");
  const fits = ({ width, height }: Placed) => Math.min(aspect / width, 1 / height);
  return fits(across) > fits(down) ? across : down;
}

function byDagre(nodes: number[], edges: number[], ends: Ends, size: (node: number) => Size, rankdir: string): Placed {
  const graph = new graphlib.Graph({ multigraph: true });
  const nodesep = rankdir === "TB" ? NODE_GAP : NODE_GAP / 2;
  graph.setGraph({ rankdir, nodesep, ranksep: LAYER_GAP, marginx: 12, marginy: 12 });
  for (const node of nodes) graph.setNode(String(node), { ...size(node) });
  for (const edge of edges) {
    const { from, to } = ends(edge);
    graph.setEdge(String(from), String(to), {}, String(edge));
  }
  dagreLayout(graph);
  const whole = graph.graph() as Size;
  return {
    centres: new Map(nodes.map((node) => [node, graph.node(String(node)) as { x: number; y: number }])),
    lines: new Map(
      edges.map((edge) => {
        const { from, to } = ends(edge);
        return [edge, graph.edge(String(from), String(to), String(edge)).points as { x: number; y: number }[]];
      }),
    ),
    width: whole.width,
    height: whole.height,
  };
}

/** Layers by the longest way from the top, each in the order in which its nodes are met. */
function inLayers(nodes: number[], edges: number[], ends: Ends, size: (node: number) => Size, aspect: number): Placed {
  const layers: number[][] = [];
  const depths = depthsOf(nodes, edges, ends);
  for (const node of nodes) (layers[depths.get(node)!] ??= []).push(node);
  const wide = nodes.reduce((most, node) => Math.max(most, size(node).width), 0) + NODE_GAP;
  const high = nodes.reduce((most, node) => Math.max(most, size(node).height), 0) + LAYER_GAP;
  const most = Math.ceil(Math.sqrt((nodes.length * aspect * high) / wide));
  const lines = layers.filter(Boolean).flatMap((layer) => wrapped(layer, most));
  const width = wide * Math.max(...lines.map((line) => line.length));
  const centres = new Map<number, { x: number; y: number }>();
  lines.forEach((line, row) =>
    line.forEach((node, place) =>
      centres.set(node, { x: width / 2 + (place - (line.length - 1) / 2) * wide, y: (row + 0.5) * high }),
    ),
  );
  const straight = (edge: number) => {
    const { from, to } = ends(edge);
    const [a, b] = [centres.get(from)!, centres.get(to)!];
    return [{ x: a.x, y: a.y + size(from).height / 2 }, { x: b.x, y: b.y - size(to).height / 2 }];
  };
  return { centres, lines: new Map(edges.map((edge) => [edge, straight(edge)])), width, height: high * lines.length };
}

function depthsOf(nodes: number[], edges: number[], ends: Ends): Map<number, number> {
  const below = new Map<number, number[]>(nodes.map((node) => [node, []]));
  const waiting = new Map<number, number>(nodes.map((node) => [node, 0]));
  for (const edge of edges) {
    const { from, to } = ends(edge);
    below.get(from)!.push(to);
    waiting.set(to, waiting.get(to)! + 1);
  }
  const depths = new Map<number, number>(nodes.map((node) => [node, 0]));
  const ready = nodes.filter((node) => !waiting.get(node));
  for (const node of ready) {
    for (const next of below.get(node)!) {
      depths.set(next, Math.max(depths.get(next)!, depths.get(node)! + 1));
      waiting.set(next, waiting.get(next)! - 1);
      if (!waiting.get(next)) ready.push(next);
    }
  }
  return depths;
}

function wrapped(layer: number[], most: number): number[][] {
  const lines: number[][] = [];
  for (let first = 0; first < layer.length; first += most) lines.push(layer.slice(first, first + most));
  return lines;
}
