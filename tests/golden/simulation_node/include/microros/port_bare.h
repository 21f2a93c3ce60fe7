#error "The component 'port_bare' is not selected: add `target: {name: …}` to microros.yaml and generate again"
