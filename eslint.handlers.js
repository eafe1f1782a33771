// A rule: a handler `on…` returns nothing that may be false, as that cancels its event: a key, a touch, a drop.

const HANDLER = /^on[a-z]+$/;
const CALLED = new Set(['CallExpression', 'ChainExpression']);

/** What an expression may come to: the values that a choice between them leaves. */
function valuesOf(node) {
  if (node.type === 'ConditionalExpression') return [node.consequent, node.alternate].flatMap(valuesOf);
  if (node.type === 'LogicalExpression') return [node.left, node.right].flatMap(valuesOf);
  if (node.type === 'SequenceExpression') return valuesOf(node.expressions.at(-1));
  if (node.type === 'AssignmentExpression') return node.operator === '=' ? valuesOf(node.right) : [node];
  return [node];
}

/** Whether one of the values of an expression is true or false, or chosen by what is (`a && b` may be a). */
function judges(node) {
  if (node.type === 'ConditionalExpression') return judges(node.consequent) || judges(node.alternate);
  if (node.type === 'LogicalExpression') return node.operator !== '??' || judges(node.left) || judges(node.right);
  if (node.type === 'BinaryExpression') return /^[<>=!]=?|^in(stanceof)?$/.test(node.operator);
  if (node.type === 'UnaryExpression') return node.operator === '!' || node.operator === 'delete';
  if (node.type === 'Literal') return typeof node.value === 'boolean';
  if (node.type === 'SequenceExpression') return judges(node.expressions.at(-1));
  if (node.type === 'AssignmentExpression') return node.operator.length > 2 || judges(node.right);
  return false;
}

/** What a function returns, but for functions within it. */
function returnsOf({ body }) {
  if (body.type !== 'BlockStatement') return [body];
  const found = [];
  const look = (node) => {
    if (node?.type === 'ReturnStatement') return node.argument && found.push(node.argument);
    if (!node || typeof node.type !== 'string' || /Function|^Class/.test(node.type)) return;
    for (const [key, value] of Object.entries(node)) if (key !== 'parent') [value].flat().forEach(look);
  };
  look(body);
  return found;
}

/** The function of this file that a call is of, by its name. */
function calledBy(node, functions) {
  const call = node.type === 'ChainExpression' ? node.expression : node;
  const { callee } = call;
  if (callee?.type === 'Identifier') return functions.get(callee.name);
  const own = callee?.type === 'MemberExpression' && callee.object.type === 'ThisExpression';
  return own ? functions.get(`this.${callee.property.name}`) : undefined;
}

/** Whether a function may return true or false, also by what it calls of its own file. */
function mayJudge(fn, functions, seen = new Set()) {
  if (seen.has(fn)) return false;
  seen.add(fn);
  return returnsOf(fn).some((value) => {
    if (judges(value)) return true;
    const calls = valuesOf(value).filter(({ type }) => CALLED.has(type));
    return calls.some((call) => {
      const called = calledBy(call, functions);
      return called && !called.async && mayJudge(called, functions, seen);
    });
  });
}

export default {
  rules: {
    silent: {
      meta: { type: 'problem', messages: { returns: 'A handler that returns false cancels its event: use { … }' } },
      create(context) {
        const functions = new Map();
        const handlers = [];
        const handler = (name, value) => {
          if (HANDLER.test(name ?? '') && /Function/.test(value?.type)) handlers.push(value);
        };
        return {
          FunctionDeclaration: (node) => node.id && functions.set(node.id.name, node),
          VariableDeclarator: ({ id, init }) => /Function/.test(init?.type) && functions.set(id.name, init),
          MethodDefinition: ({ key, value }) => functions.set(`this.${key.name}`, value),
          Property: ({ key, value }) => handler(key.name, value),
          AssignmentExpression: ({ left, right }) => {
            const last = right.type === 'AssignmentExpression' ? right.right : right;
            handler(left.property?.name, last);
          },
          'Program:exit': () => {
            for (const each of new Set(handlers))
              if (!each.async && mayJudge(each, functions)) context.report({ node: each, messageId: 'returns' });
          },
        };
      },
    },
  },
};
