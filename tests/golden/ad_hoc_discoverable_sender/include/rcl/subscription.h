#error "The component 'subscribe' is not selected: add `components: [+subscribe]` to microros.yaml and generate again"
